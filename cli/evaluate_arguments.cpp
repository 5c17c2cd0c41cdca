// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate_arguments.hpp"

#include <algorithm>
#include <charconv>

namespace waylode::cli {
namespace {

constexpr double kLongestPeriod_s = 3600.0;

tl::unexpected<core::Error> refuse(const std::string& message, const char* option) {
  return core::fail(core::ErrorCode::kInvalidArgument, message, option);
}

core::Result<double> parse_period(const std::string& text) {
  double period_s = 0.0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, period_s);
  if (parsed.ec != std::errc() || parsed.ptr != end ||
      !(period_s > 0.0 && period_s <= kLongestPeriod_s)) {
    return refuse("'" + text + "' is no period; write seconds, above 0 and at most 3600",
                  "--scan-periods");
  }
  return period_s;
}

}  // namespace

void add_common_arguments(Verb& verb, EvaluateArguments& arguments) {
  verb.argument("--methods", arguments.methods, "Methods to compare; see `waylode methods`")
      .comma_separated();
  verb.argument("--floor", arguments.floor, "Whether the floor is told to the methods")
      .one_of({"known", "unknown"});
  verb.argument("--scan-period", arguments.scan_period_s,
                "Least time between Wi-Fi scans of the tests (s); 0 keeps all")
      .in_range(0.0, kLongestPeriod_s);
  verb.argument("--scan-periods", arguments.scan_periods,
                "Evaluate with each of these periods (s) as well, such as 2,5,10,30,120")
      .comma_separated();
  verb.argument("--thin-bluetooth", arguments.thin_bluetooth,
                "Whether Bluetooth is thinned with the Wi-Fi scans: 2 s are heard each period")
      .one_of({"on", "off"});
  verb.argument("--device-offset", arguments.device_offset_db,
                "Added to every RSSI of the tests (dB): another phone than the surveyor's")
      .in_range(-40.0, 40.0);
  verb.argument("--wrong-start", arguments.wrong_start_m,
                "Also begin each test this far (m) off and tell how many recover; 0 does not")
      .in_range(0.0, 10'000.0);
  verb.argument("--out", arguments.out, "Write the figures as JSON to this file");
  verb.argument("--report", arguments.report, "Write an HTML page with plans, tracks and curves");
  verb.argument("--chart", arguments.chart,
                "Write the chart of error by scan period (SVG); needs --scan-periods");
  verb.argument("--config", arguments.config, "Options other than the defaults (TOML)");
}

void add_split_arguments(Verb& verb, EvaluateArguments& arguments) {
  verb.argument("--seed", arguments.seed,
                "Deals the recordings differently when there is no --split");
  verb.argument("--fold", arguments.fold,
                "K/N: the Kth of N parts is test, instead of 1/4; without --split");
  verb.argument("--unlabelled", arguments.unlabelled,
                "Share of the training recordings to keep aside without marks")
      .in_range(0.0, 0.95);
}

core::Result<Dealing> dealing_of(const EvaluateArguments& arguments) {
  Dealing dealing;
  if (arguments.split && arguments.fold) {
    return refuse("the table says which recordings test; drop --fold or --split", "--fold");
  }
  if (arguments.split && arguments.seed && arguments.unlabelled == 0.0) {
    return refuse("the table says which recordings test; drop --seed or --split", "--seed");
  }
  dealing.seed = arguments.seed.value_or(dealing.seed);
  dealing.unlabelled_ratio = arguments.unlabelled;
  if (arguments.fold) {
    const auto fold = parse_fold(*arguments.fold);
    if (!fold) return tl::unexpected(fold.error());
    dealing.fold = *fold;
  }
  return dealing;
}

Alteration alteration_of(const EvaluateArguments& arguments) {
  return {arguments.scan_period_s, arguments.thin_bluetooth == "on", arguments.device_offset_db};
}

core::Result<std::vector<double>> scan_periods_of(const EvaluateArguments& arguments) {
  if (arguments.scan_periods.empty()) return std::vector<double>{};
  std::vector<double> periods_s = {0.0};
  for (const std::string& text : arguments.scan_periods) {
    const auto period_s = parse_period(text);
    if (!period_s) return tl::unexpected(period_s.error());
    if (std::ranges::find(periods_s, *period_s) != periods_s.end()) {
      return refuse("'" + text + "' is given twice", "--scan-periods");
    }
    periods_s.push_back(*period_s);
  }
  return periods_s;
}

core::Result<void> check_arguments(const EvaluateArguments& arguments) {
  if (auto periods = scan_periods_of(arguments); !periods) return tl::unexpected(periods.error());
  if (arguments.chart && arguments.scan_periods.empty()) {
    return refuse("the chart is of scan periods; give --scan-periods, such as 2,5,10,30,120",
                  "--chart");
  }
  if (!arguments.scan_periods.empty() && arguments.scan_period_s > 0.0) {
    return refuse("each period is evaluated by itself; drop --scan-period", "--scan-periods");
  }
  return {};
}

}  // namespace waylode::cli
