// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// How fast logs become samples, from memory and on one core. $WAYLODE_DATA, else ../shared/data
// below the current folder, may hold the real recordings; without them a log is generated.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "waylode/log/detail/byte_stream.hpp"
#include "waylode/log/getsensordata_decoder.hpp"
#include "waylode/log/ilc_decoder.hpp"

namespace waylode {
namespace {

/// The first log (by path) below a folder of the data root, decompressed; empty if there is none.
std::string load_real_log(const std::string& folder) {
  const char* variable = std::getenv("WAYLODE_DATA");
  const std::filesystem::path root =
      std::filesystem::path(variable != nullptr ? variable : "../shared/data") / folder;
  if (!std::filesystem::is_directory(root)) return {};
  std::vector<std::filesystem::path> logs;
  for (const auto& entry : std::filesystem::directory_iterator(root)) logs.push_back(entry.path());
  if (logs.empty()) return {};
  std::string text;
  const auto trouble = log::detail::stream_file(*std::min_element(logs.begin(), logs.end()),
                                                [&text](std::string_view bytes) {
                                                  text += bytes;
                                                  return true;
                                                });
  return trouble && !*trouble ? text : std::string();
}

/// Sensor records at 50 Hz and a scan of 200 rows every two seconds, as real logs mix them.
std::string generate_ilc_log() {
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    const std::string time = std::to_string(1'700'000'000'000 + 20 * i);
    const std::string digits = std::to_string(10'000'000 + i * 7'919 % 9'999'991);
    const std::string triple = "\t-0." + digits + "\t9." + digits + "\t-27." + digits;
    for (const char* type : {"ACCELEROMETER", "MAGNETIC_FIELD", "GYROSCOPE"}) {
      text += time + "\tTYPE_" + type + triple + "\t3\n";
      text += time + "\tTYPE_" + type + "_UNCALIBRATED" + triple + triple + "\t3\n";
    }
    text += time + "\tTYPE_ROTATION_VECTOR\t0.05" + digits + "\t0.001" + digits + "\t-0.9\t3\n";
    for (int row = 0; i % 100 == 0 && row < 200; ++row) {
      text += time + "\tTYPE_WIFI\tnetwork\t04:40:a9:fb:32:" + std::to_string(row % 90 + 10) +
              "\t-61\t5745\t" + time + "\n";
    }
  }
  return text;
}

template <typename MakeDecoder>
void decode(benchmark::State& state, const std::string& text, const MakeDecoder& make_decoder) {
  constexpr std::size_t kPieceBytes = 256 * 1024;
  std::uint64_t sample_count = 0;
  for (auto _ : state) {
    const auto decoder = make_decoder([&sample_count](sample::Sample&& sample) {
      benchmark::DoNotOptimize(sample);
      ++sample_count;
    });
    for (std::size_t at = 0; at < text.size(); at += kPieceBytes) {
      decoder->feed(std::string_view(text).substr(at, kPieceBytes));
    }
    decoder->finish();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
  state.counters["samples"] =
      benchmark::Counter(static_cast<double>(sample_count), benchmark::Counter::kIsRate);
}

void decode_ilc(benchmark::State& state) {
  std::string text = load_real_log("ilc/site1/F1/path_data_files");
  state.SetLabel(text.empty() ? "generated" : "real");
  if (text.empty()) text = generate_ilc_log();
  decode(state, text, log::make_ilc_decoder);
}
BENCHMARK(decode_ilc);

void decode_getsensordata(benchmark::State& state) {
  const std::string text = load_real_log("ipin2023/logs");
  if (text.empty()) return state.SkipWithError("real recordings not found; set WAYLODE_DATA");
  decode(state, text, log::make_getsensordata_decoder);
}
BENCHMARK(decode_getsensordata);

}  // namespace
}  // namespace waylode
