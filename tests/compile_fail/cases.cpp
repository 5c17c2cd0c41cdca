// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// What the strong types of core must refuse. Without a CASE_ everything here compiles.
#include <chrono>
#include <cstdint>

#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"

using waylode::core::DeviceTime;
using waylode::core::Duration;
using waylode::core::FloorId;
using waylode::core::TransmitterId;
using waylode::core::UtcTime;

bool use_strong_types(DeviceTime device, UtcTime utc, FloorId floor, TransmitterId transmitter) {
  const Duration walked = (device + Duration(5)) - device;
  const FloorId above{static_cast<std::uint16_t>(floor.index + 1)};
  const TransmitterId other = TransmitterId::wifi(0x0A1B2C3D4E5F);

#ifdef CASE_device_time_minus_utc_time
  // expect: no match for .operator-.|invalid operands
  const Duration mixed = device - utc;
#endif
#ifdef CASE_device_time_compared_with_utc_time
  // expect: no match for .operator<.|invalid operands
  const bool earlier = device < utc;
#endif
#ifdef CASE_device_time_from_utc_time
  // expect: conversion from|no viable conversion
  const DeviceTime converted = utc;
#endif
#ifdef CASE_utc_time_from_system_clock
  // expect: conversion from|no viable conversion
  const UtcTime converted = std::chrono::system_clock::time_point();
#endif
#ifdef CASE_device_time_from_bare_number
  // expect: conversion from|no viable conversion
  const DeviceTime converted = 12;
#endif
#ifdef CASE_duration_from_seconds_in_double
  // expect: conversion from|no viable conversion
  const Duration converted = 1.5;
#endif
#ifdef CASE_floor_plus_number
  // expect: no match for .operator\+.|invalid operands
  const FloorId sum = floor + 1;
#endif
#ifdef CASE_floor_minus_floor
  // expect: no match for .operator-.|invalid operands
  const auto difference = above - floor;
#endif
#ifdef CASE_floor_as_number
  // expect: cannot convert|no viable conversion
  const int number = floor;
#endif
#ifdef CASE_transmitter_from_integer
  // expect: conversion from|no viable conversion
  const TransmitterId guessed = 0x0A1B2C3D4E5F;
#endif
#ifdef CASE_transmitter_constructed_from_integer
  // expect: no matching (function|constructor) for
  const TransmitterId guessed(std::uint64_t{0x0A1B2C3D4E5F});
#endif
#ifdef CASE_transmitter_plus_number
  // expect: no match for .operator\+.|invalid operands
  const auto next = transmitter + 1;
#endif
#ifdef CASE_transmitter_compared_with_floor
  // expect: no match for .operator==.|invalid operands
  const bool same = transmitter == floor;
#endif

  return walked > Duration(1) && above != floor && other != transmitter && utc > UtcTime();
}
