// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/radio_map_check.hpp"

#include <cmath>

namespace waylode::site::detail {
namespace {

std::string at(const char* array, std::size_t index, const char* defect) {
  return std::string(array) + " entry " + std::to_string(index) + " " + defect;
}

std::string defect_of_fingerprints(const RadioMap& map, std::size_t floor_count) {
  constexpr const char* kArray = "radio.fingerprints";
  for (std::size_t i = 0; i < map.fingerprints.size(); ++i) {
    const FingerprintRecord& record = map.fingerprints[i];
    if (!std::isfinite(record.x_m) || !std::isfinite(record.y_m)) {
      return at(kArray, i, "has no finite position");
    }
    if (!std::isfinite(record.position_sigma_m) || record.position_sigma_m < 0.0F) {
      return at(kArray, i, "has no usable position sigma");
    }
    if (record.floor >= floor_count) return at(kArray, i, "names a floor that does not exist");
    if (i > 0 && map.fingerprints[i - 1].floor > record.floor) {
      return at(kArray, i, "is not in the order of floors");
    }
  }
  return {};
}

std::string defect_of_lists(const RadioMap& map) {
  if (map.transmitters.empty() && map.posting_begin.empty() && map.postings.empty()) return {};
  if (map.posting_begin.size() != map.transmitters.size() + 1) {
    return "radio.posting_begin has not one entry more than radio.transmitters";
  }
  if (map.posting_begin.front() != 0 || map.posting_begin.back() != map.postings.size()) {
    return "radio.posting_begin does not span radio.postings";
  }
  for (std::size_t i = 0; i < map.transmitters.size(); ++i) {
    if (i > 0 && map.transmitters[i - 1] >= map.transmitters[i]) {
      return at("radio.transmitters", i, "is not in ascending order");
    }
    if (map.posting_begin[i] > map.posting_begin[i + 1]) {
      return at("radio.posting_begin", i + 1, "is not in ascending order");
    }
  }
  return {};
}

/// Lists must be sound.
std::string defect_of_postings(const RadioMap& map) {
  constexpr const char* kArray = "radio.postings";
  for (std::size_t list = 0; list < map.transmitters.size(); ++list) {
    for (std::size_t i = map.posting_begin[list]; i < map.posting_begin[list + 1]; ++i) {
      const Posting& posting = map.postings[i];
      if (posting.fingerprint >= map.fingerprints.size()) {
        return at(kArray, i, "names a fingerprint that does not exist");
      }
      if (i > map.posting_begin[list] && map.postings[i - 1].fingerprint >= posting.fingerprint) {
        return at(kArray, i, "is not in the order of fingerprints");
      }
    }
  }
  return {};
}

}  // namespace

std::string defect_of(const RadioMap& map, std::size_t floor_count) {
  std::string defect = defect_of_fingerprints(map, floor_count);
  if (defect.empty()) defect = defect_of_lists(map);
  if (defect.empty()) defect = defect_of_postings(map);
  return defect;
}

}  // namespace waylode::site::detail
