// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <utility>

#include "waylode/pipeline/options_visitor.hpp"

namespace waylode::pipeline::detail {

using Visit = std::function<void(const OptionRef&)>;

inline constexpr double kHuge = 1e6;

/// Visits the members of one table.
class Table {
 public:
  Table(std::string_view name, const Visit& visit) : name_(name), visit_(&visit) {}

  template <typename Number>
  const Table& number(std::string_view name, Number& target, double smallest, double largest,
                      std::string_view comment) const {
    (*visit_)({name_, name, &target, smallest, largest, comment});
    return *this;
  }
  const Table& choice(std::string_view name, Choice choice, std::string_view comment) const {
    (*visit_)({name_, name, std::move(choice), 0.0, 0.0, comment});
    return *this;
  }

 private:
  std::string_view name_;
  const Visit* visit_;
};

/// The tables of the parts of dead reckoning that methods choose from.
void visit_gait_options(Options& options, const Visit& visit);
/// The tables of the papers' ways with radio, field and fusion.
void visit_paper_options(Options& options, const Visit& visit);

}  // namespace waylode::pipeline::detail
