// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/experiment/step_counting.hpp"

namespace waylode::cli {

struct OxfordDataset {
  std::vector<experiment::StepRecording> recordings;  ///< By name.
  std::vector<std::string> notes;                     ///< What was left out or is odd, and why.
};

/// The Oxford step counter data set: an archive (*.tar.zst) or a folder that holds it unpacked.
/// Every folder below with accelerometer.csv (t_ns,accuracy,ax,ay,az) and stepcounter.csv
/// (t_ns,left,right) is a recording; where there is a stats.csv, only those it lists. A true step
/// is a 0->1 edge of either foot switch while the accelerometer ran. Placements are in lower case,
/// since the data set writes them both ways. A line that is malformed is kTableInvalid with
/// "file:line"; kLogLacksRecords when no recording is found.
core::Result<OxfordDataset> load_oxford_dataset(const std::filesystem::path& path);

/// The same from the files by their names.
core::Result<OxfordDataset> parse_oxford_dataset(const std::map<std::string, std::string>& files,
                                                 const std::string& place);

}  // namespace waylode::cli
