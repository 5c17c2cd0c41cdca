// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "waylode/sample/sample.hpp"

namespace waylode::cli {

/// How test recordings are made harder than they were: never the training ones.
struct Alteration {
  double scan_period_s = 0.0;     ///< Least time between kept scans; >= 0, 0 keeps all as recorded.
  bool thin_bluetooth = true;     ///< Bluetooth is thinned alike.
  double device_offset_db = 0.0;  ///< Added to every RSSI: a phone that hears differently.
  bool operator==(const Alteration&) const = default;
};

/// Keeps the first Wi-Fi scan with a reading and of the others those at least `period_s` after the
/// one kept before; scans without readings go. Readings that were more than 5 s old when the scan's
/// newest was heard go too: the phone has them from scans that are now taken not to have happened.
/// Bluetooth, if thinned, is heard for 2 s at a time, such windows opening `period_s` apart.
/// Samples must be in order of time; a period of 0 or less, or one that is not finite, keeps
/// everything.
void thin_scans(std::vector<sample::Sample>& samples, double period_s, bool thin_bluetooth);

/// Adds `offset_db` to the RSSI of every Wi-Fi and Bluetooth reading.
void shift_rssi(std::vector<sample::Sample>& samples, double offset_db);

void alter(std::vector<sample::Sample>& samples, const Alteration& alteration);

}  // namespace waylode::cli
