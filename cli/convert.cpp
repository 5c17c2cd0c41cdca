// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "output.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/log/mcap_writer.hpp"

namespace waylode::cli {
namespace {

struct Arguments {
  std::string log;
  std::string out;
  std::string compression = "zstd";
};

log::McapWriterOptions writer_options(const Arguments& arguments) {
  log::McapWriterOptions options;
  options.compression =
      arguments.compression == "none" ? log::McapCompression::kNone : log::McapCompression::kZstd;
  return options;
}

core::Result<void> convert(const Arguments& arguments) {
  if (auto replaceable = check_replaceable(arguments.out); !replaceable) return replaceable;
  const auto recording = log::load_recording(arguments.log);
  if (!recording) return tl::unexpected(recording.error());
  auto writer =
      log::McapWriter::create(arguments.out, recording->report.info, writer_options(arguments));
  if (!writer) return tl::unexpected(writer.error());
  std::size_t left_out = 0;
  for (const sample::Sample& sample : recording->samples) {
    const auto written = writer->write(sample);
    if (written) continue;
    if (written.error().code != core::ErrorCode::kInvalidArgument) return written;
    ++left_out;
  }
  if (auto closed = writer->close(); !closed) return closed;
  print_note(fmt::format("{}: {} samples written, {} records rejected, {} left out", arguments.out,
                         recording->samples.size() - left_out, recording->report.rejected_total(),
                         left_out));
  return {};
}

}  // namespace

void add_convert(Verb& root) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = root.verb("convert", "Turn any readable log into Waylode's own format (MCAP)");
  verb.examples("  waylode convert trace.txt.zst trace.mcap");
  verb.argument("LOG", arguments->log, "The log to read").required();
  verb.argument("OUT", arguments->out, "The MCAP file to write").required();
  verb.argument("--compression", arguments->compression, "How chunks are packed")
      .one_of({"zstd", "none"});
  verb.run([arguments] { return convert(*arguments); });
}

}  // namespace waylode::cli
