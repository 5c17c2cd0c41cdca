// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// The pieces of a message in one text.
inline std::string concat(std::initializer_list<std::string_view> pieces) {
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}

/// The first thing wrong with a scenario file, with its line.
class Complaint {
 public:
  explicit Complaint(std::string_view place) : place_(place) {}

  void say(toml::source_region where, std::string message) { say(where.begin.line, message); }
  void say(unsigned line, std::string message) {
    if (!error_)
      error_ = core::Error{core::ErrorCode::kScenarioInvalid, std::move(message),
                           place_ + ":" + std::to_string(line)};
  }
  void say(core::Error error) {
    if (!error_) error_ = std::move(error);
  }
  bool is_empty() const { return !error_; }
  core::Error take() { return std::move(*error_); }
  const std::string& place() const { return place_; }

 private:
  std::string place_;
  std::optional<core::Error> error_;
};

/// One table of a scenario file, read strictly: a wrong type or range is a complaint, and so is
/// every key that nobody asked for.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string name, Complaint& complaint)
      : table_(table), name_(std::move(name)), complaint_(complaint) {}

  /// A required key is a complaint when missing.
  void require(std::string_view key) {
    if (table_.contains(key)) return;
    complaint_.say(table_.source(), concat({name_, " lacks '", key, "'; add it"}));
  }

  void operator()(std::string_view key, double& value, double lowest, double highest) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::optional<double> given = node->is_number() ? node->value<double>() : std::nullopt;
    if (!given || !(*given >= lowest && *given <= highest)) {
      return complaint_.say(node->source(), concat({"'", key, "' must be a number from ",
                                                    shown(lowest), " to ", shown(highest)}));
    }
    value = *given;
  }
  void operator()(std::string_view key, std::optional<double>& value, double lowest,
                  double highest) {
    if (!table_.contains(key)) return;
    double given = 0.0;
    (*this)(key, given, lowest, highest);
    value = given;
  }
  void operator()(std::string_view key, bool& value) { read<bool>(key, value, "true or false"); }
  void operator()(std::string_view key, std::string& value) {
    read<std::string>(key, value, "a text in quotes");
  }
  void operator()(std::string_view key, PhoneOptions::Pose& value) {
    std::string word;
    (*this)(key, word);
    if (word.empty()) return;
    using Pose = PhoneOptions::Pose;
    if (word == "hand") {
      value = Pose::kHand;
    } else if (word == "pocket") {
      value = Pose::kPocket;
    } else if (word == "swinging") {
      value = Pose::kSwinging;
    } else {
      complaint_.say(line_of(key), "'pose' must be \"hand\", \"pocket\" or \"swinging\"");
    }
  }
  void operator()(std::string_view key, std::vector<std::string>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    const bool is_texts = array != nullptr && std::all_of(array->begin(), array->end(),
                                                          [](auto& e) { return e.is_string(); });
    if (!is_texts) {
      return complaint_.say(node->source(), concat({"'", key, "' must be a list of texts"}));
    }
    value.clear();
    for (const toml::node& element : *array) value.push_back(*element.value<std::string>());
  }

  /// A table under `key`, or nullptr.
  const toml::table* table(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return nullptr;
    if (node->as_table() == nullptr) {
      complaint_.say(node->source(), concat({"'", key, "' must be a table"}));
    }
    return node->as_table();
  }
  /// The tables of [[key]].
  std::vector<const toml::table*> tables(std::string_view key) {
    std::vector<const toml::table*> result;
    const toml::node* node = find(key);
    if (node == nullptr) return result;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
      complaint_.say(node->source(), concat({"write '", key, "' as [[", key, "]] tables"}));
      return result;
    }
    for (const toml::node& element : *array) result.push_back(element.as_table());
    return result;
  }

  unsigned line() const { return table_.source().begin.line; }
  unsigned line_of(std::string_view key) const {
    const toml::node* node = table_.get(key);
    return node == nullptr ? line() : node->source().begin.line;
  }

  /// Complains about keys nobody read.
  void finish() {
    for (const auto& [key, node] : table_) {
      if (known_.count(std::string(key.str())) != 0) continue;
      complaint_.say(key.source(), concat({name_, " has no option '", key.str(), "'; remove it"}));
    }
  }

 private:
  const toml::node* find(std::string_view key) {
    known_.emplace(key);
    return table_.get(key);
  }
  template <typename T>
  void read(std::string_view key, T& value, const char* what) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::optional<T> given = node->value_exact<T>();
    if (!given) {
      return complaint_.say(node->source(), concat({"'", key, "' must be ", what}));
    }
    value = *given;
  }
  static std::string shown(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }

  const toml::table& table_;
  std::string name_;
  Complaint& complaint_;
  std::set<std::string> known_;
};

}  // namespace waylode::sim::detail
