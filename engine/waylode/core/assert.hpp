// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Our own invariants, never anything that input can reach. On in dev, ci, asan and fuzz builds.
#ifdef WAYLODE_ASSERTS
#define WAYLODE_ASSERT(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#else
#define WAYLODE_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#endif
