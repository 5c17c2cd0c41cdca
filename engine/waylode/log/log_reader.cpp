// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/log_reader.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "waylode/log/detail/byte_stream.hpp"
#include "waylode/log/detail/format_sniffer.hpp"
#include "waylode/log/getsensordata_decoder.hpp"
#include "waylode/log/ilc_decoder.hpp"
#include "waylode/log/mcap_decoder.hpp"

namespace waylode::log {
namespace {

std::unique_ptr<Decoder> make_decoder(LogFormat format, const SampleSink& sink) {
  switch (format) {
    case LogFormat::kIlc:
      return make_ilc_decoder(sink);
    case LogFormat::kGetSensorData:
      return make_getsensordata_decoder(sink);
    case LogFormat::kMcap:
      break;
  }
  return make_mcap_decoder(sink);
}

/// Holds back the head of a log until it shows the format, then decodes.
class LogIntake {
 public:
  explicit LogIntake(const SampleSink& sink) : sink_(sink) {}

  /// False once it is clear that the bytes are no log.
  bool feed(std::string_view bytes) {
    if (decoder_ == nullptr) {
      head_.append(bytes);
      return head_.size() < detail::kSniffBytes || start_decoding();
    }
    decoder_->feed(bytes);
    return true;
  }

  core::Result<LogReport> finish(const detail::StreamTrouble& trouble, const std::string& name);

 private:
  bool start_decoding() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    const std::optional<LogFormat> format = detail::sniff_format(head_);
    if (!format) return false;
    decoder_ = make_decoder(*format, sink_);
    const std::string head = std::exchange(head_, {});
    const bool is_marked = head.starts_with(kByteOrderMark);
    decoder_->feed(std::string_view(head).substr(is_marked ? kByteOrderMark.size() : 0));
    return true;
  }

  const SampleSink& sink_;
  std::string head_;
  std::unique_ptr<Decoder> decoder_;
};

core::Result<LogReport> LogIntake::finish(const detail::StreamTrouble& trouble,
                                          const std::string& name) {
  if (decoder_ == nullptr && head_.empty()) {
    if (trouble)
      return core::fail(core::ErrorCode::kLogCorrupt, *trouble + "; fetch it anew", name);
    return core::fail(core::ErrorCode::kLogEmpty, "the log is empty; record or fetch it anew",
                      name);
  }
  if (decoder_ == nullptr && !start_decoding()) {
    return core::fail(core::ErrorCode::kLogUnrecognised,
                      "not a log of a known format; give an ILC, GetSensorData or MCAP log, plain "
                      "or compressed with zstd",
                      name);
  }
  decoder_->finish();
  LogReport report = decoder_->report();
  if (trouble) report.truncated = *trouble;
  if (!report.accepted.empty() || !report.ignored.empty()) return report;
  if (report.rejected_total() != 0) {
    return core::fail(core::ErrorCode::kLogCorrupt,
                      "every record is bad, the first for \"" + report.rejected.begin()->first +
                          "\"; fetch or record it anew",
                      name);
  }
  return core::fail(core::ErrorCode::kLogEmpty, "the log holds no record; record or fetch it anew",
                    name);
}

}  // namespace

core::Result<LogReport> read_log(const std::filesystem::path& path, const SampleSink& sink) {
  LogIntake intake(sink);
  const auto trouble =
      detail::stream_file(path, [&intake](std::string_view bytes) { return intake.feed(bytes); });
  if (!trouble) return tl::unexpected(trouble.error());
  return intake.finish(*trouble, path.string());
}

core::Result<LogReport> read_log_bytes(std::string_view bytes, std::string_view name,
                                       const SampleSink& sink) {
  LogIntake intake(sink);
  const auto trouble =
      detail::stream_bytes(bytes, [&intake](std::string_view chunk) { return intake.feed(chunk); });
  return intake.finish(trouble, std::string(name));
}

core::Result<Recording> load_recording(const std::filesystem::path& path) {
  Recording recording;
  auto report = read_log(path, [&recording](sample::Sample&& sample) {
    recording.samples.push_back(std::move(sample));
  });
  if (!report) return tl::unexpected(std::move(report.error()));
  recording.report = std::move(*report);
  std::stable_sort(recording.samples.begin(), recording.samples.end(),
                   [](const sample::Sample& a, const sample::Sample& b) {
                     return sample::time_of(a) < sample::time_of(b);
                   });
  return recording;
}

}  // namespace waylode::log
