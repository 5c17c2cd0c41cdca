// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "log_summary.hpp"

namespace waylode::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kAgeShares[] = {0.5, 0.9, 1.0};

struct Arguments {
  std::string log;
  bool json = false;
};

std::optional<std::string> utc_text(const std::optional<core::UtcTime>& time) {
  if (!time) return std::nullopt;
  const auto whole = std::chrono::floor<std::chrono::seconds>(time->time_since_epoch());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time_t{whole.count()}));
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json optional_or_null(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json(nullptr);
}

std::string to_json(const std::string& path, const LogSummary& summary) {
  const log::LogReport& report = summary.report;
  Json kinds = Json::object();
  for (const auto& [name, kind] : summary.kinds) {
    kinds[name] = {{"n", kind.count}, {"rate_hz", kind.rate_hz()}};
  }
  Json ages = Json::object();
  for (const double share : kAgeShares) {
    ages[fmt::format("p{:.0f}", 100.0 * share)] = summary.wifi_age_quantile_s(share);
  }
  const Json out = {{"log", path},
                    {"format", log::to_string(report.format)},
                    {"device_brand", text_or_null(report.info.device_brand)},
                    {"device_model", text_or_null(report.info.device_model)},
                    {"site", text_or_null(report.info.site)},
                    {"floor", text_or_null(report.info.floor)},
                    {"start_utc", optional_or_null(utc_text(report.info.start_utc))},
                    {"duration_s", summary.duration_s()},
                    {"bytes_read", report.bytes_read},
                    {"kinds", kinds},
                    {"wifi",
                     {{"readings", summary.wifi_readings},
                      {"transmitters", summary.wifi_transmitters.size()},
                      {"age_s", summary.wifi_ages_s.empty() ? Json(nullptr) : ages}}},
                    {"bluetooth", {{"transmitters", summary.bluetooth_transmitters.size()}}},
                    {"marks_by_floor", summary.marks_by_floor},
                    {"rejected", report.rejected},
                    {"ignored", report.ignored},
                    {"recovered_run_on", report.recovered_run_on},
                    {"truncated", optional_or_null(report.truncated)}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string header_text(const std::string& path, const LogSummary& summary) {
  const sample::RecordingInfo& info = summary.report.info;
  std::string text =
      fmt::format("log        {}\nformat     {}\n", path, log::to_string(summary.report.format));
  text += fmt::format("device     {} {}\n", or_dash(info.device_brand), or_dash(info.device_model));
  text += fmt::format("place      site {}, floor {}\n", or_dash(info.site), or_dash(info.floor));
  text += fmt::format("start      {}\n", utc_text(info.start_utc).value_or("-"));
  text += fmt::format("duration   {:.1f} s\n", summary.duration_s());
  return text;
}

std::string samples_text(const LogSummary& summary) {
  std::string text = fmt::format("\n{:<28}{:>10}{:>12}\n", "samples", "count", "per second");
  for (const auto& [name, kind] : summary.kinds) {
    text += fmt::format("  {:<26}{:>10}{:>12.2f}\n", name, kind.count, kind.rate_hz());
  }
  return text;
}

std::string radio_text(const LogSummary& summary) {
  std::string text = fmt::format("\nWi-Fi      {} readings of {} transmitters\n",
                                 summary.wifi_readings, summary.wifi_transmitters.size());
  if (!summary.wifi_ages_s.empty()) {
    text += "reading age";
    for (const double share : kAgeShares) {
      text += fmt::format("  p{:.0f} {:.1f} s", 100.0 * share, summary.wifi_age_quantile_s(share));
    }
    text += "\n";
  }
  text += fmt::format("Bluetooth  {} transmitters\n", summary.bluetooth_transmitters.size());
  for (const auto& [floor, count] : summary.marks_by_floor) {
    text += fmt::format("marks      {} on floor {}\n", count,
                        floor.empty() ? or_dash(summary.report.info.floor) : floor);
  }
  return text;
}

std::string trouble_text(const log::LogReport& report) {
  std::string text = "\n";
  for (const auto& [reason, count] : report.rejected) {
    text += fmt::format("rejected   {} x {}\n", count, reason);
  }
  for (const auto& [kind, count] : report.ignored) {
    text += fmt::format("ignored    {} x {}\n", count, kind);
  }
  if (report.recovered_run_on > 0) {
    text +=
        fmt::format("recovered  {} records from lines that held two\n", report.recovered_run_on);
  }
  if (report.truncated) text += fmt::format("truncated  {}\n", *report.truncated);
  return text == "\n" ? "\nevery record was understood\n" : text;
}

core::Result<void> inspect(const Arguments& arguments) {
  const auto summary = summarise_log(arguments.log);
  if (!summary) return tl::unexpected(summary.error());
  print(arguments.json ? to_json(arguments.log, *summary)
                       : header_text(arguments.log, *summary) + samples_text(*summary) +
                             radio_text(*summary) + trouble_text(summary->report));
  return {};
}

}  // namespace

void add_inspect(Verb& root) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = root.verb("inspect", "Tell what a log holds and what of it could not be read");
  verb.examples("  waylode inspect walk.mcap\n  waylode inspect trace.txt.zst --json");
  verb.argument("LOG", arguments->log,
                "The log: ILC, GetSensorData or Waylode's MCAP, plain or .zst")
      .required();
  verb.argument("--json", arguments->json, "Print JSON");
  verb.run([arguments] { return inspect(*arguments); });
}

}  // namespace waylode::cli
