// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/model_file.hpp"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace waylode::learn {
namespace {

using core::ErrorCode;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

constexpr const char* kFormat = "waylode regression";
constexpr int kVersion = 1;
constexpr const char* kRelevance = "relevance vectors";
constexpr const char* kSupport = "support vectors";

json to_json(const VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

json to_json(const MatrixXd& matrix) {
  json rows = json::array();
  for (Index i = 0; i < matrix.rows(); ++i) rows.push_back(to_json(VectorXd(matrix.row(i))));
  return rows;
}

json to_json(const InputScaler& scaler) {
  return {{"low", scaler.low()},
          {"span", scaler.span()},
          {"clip_low", scaler.options().clip_low},
          {"clip_high", scaler.options().clip_high}};
}

json to_json(const Kernel::Options& kernel) {
  const bool sum = kernel.combination == Kernel::Combination::kSum;
  return {{"combination", sum ? "sum" : "product"},
          {"spline_weight", kernel.spline_weight},
          {"gauss_weight", kernel.gauss_weight},
          {"laplace_weight", kernel.laplace_weight},
          {"gauss_rate", kernel.gauss_rate},
          {"laplace_rate", kernel.laplace_rate},
          {"normalise_spline", kernel.normalise_spline}};
}

json to_json(const RelevanceVectorRegression& regressor) {
  const auto& model = regressor.model();
  return {{"kind", kRelevance},
          {"kernel", to_json(model.kernel)},
          {"offset", model.offset},
          {"has_bias", model.has_bias},
          {"vectors", to_json(model.vectors)},
          {"weights", to_json(model.weights)},
          {"covariance", to_json(model.covariance)},
          {"noise_variance", model.noise_variance}};
}

json to_json(const SupportVectorRegression& regressor) {
  const auto& model = regressor.model();
  return {{"kind", kSupport},
          {"gauss_rate", model.gauss_rate},
          {"bias", model.bias},
          {"vectors", to_json(model.vectors)},
          {"weights", to_json(model.weights)}};
}

// The readers throw json::exception or Unusable; parse_model turns both into an Error.
struct Unusable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Just these members.
void require_members(const json& value, std::initializer_list<const char*> names) {
  if (!value.is_object() || value.size() != names.size()) {
    throw Unusable("an object lacks a member or has one too many");
  }
  for (const char* name : names) {
    if (!value.contains(name)) throw Unusable(std::string("there is no \"") + name + '"');
  }
}

double number(const json& value) {
  const double read = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(read)) throw Unusable("a value is no finite number");
  return read;
}

bool flag(const json& value) {
  if (!value.is_boolean()) throw Unusable("a value is not true or false");
  return value.get<bool>();
}

void require_list(const json& value) {
  if (!value.is_array()) throw Unusable("a value is no list");
}

VectorXd vector(const json& value) {
  require_list(value);
  VectorXd read(static_cast<Index>(value.size()));
  for (std::size_t i = 0; i < value.size(); ++i) read(static_cast<Index>(i)) = number(value[i]);
  return read;
}

MatrixXd matrix(const json& value, Index columns) {
  require_list(value);
  // Every row is of the length told before memory is taken for them.
  for (const json& row : value) {
    require_list(row);
    if (static_cast<Index>(row.size()) != columns) throw Unusable("a row has not its length");
  }
  MatrixXd read(static_cast<Index>(value.size()), columns);
  for (std::size_t i = 0; i < value.size(); ++i) {
    read.row(static_cast<Index>(i)) = vector(value[i]).transpose();
  }
  return read;
}

template <typename T>
T sound(core::Result<T>&& result) {
  if (!result) throw Unusable(result.error().message);
  return *std::move(result);
}

InputScaler scaler(const json& value) {
  require_members(value, {"low", "span", "clip_low", "clip_high"});
  return sound(InputScaler::from_range(
      number(value["low"]), number(value["span"]),
      {.clip_low = number(value["clip_low"]), .clip_high = number(value["clip_high"])}));
}

Kernel::Combination combination(const json& value) {
  if (value == "sum") return Kernel::Combination::kSum;
  if (value == "product") return Kernel::Combination::kProduct;
  throw Unusable("a kernel is a sum or a product");
}

Kernel::Options kernel(const json& value) {
  require_members(value, {"combination", "spline_weight", "gauss_weight", "laplace_weight",
                          "gauss_rate", "laplace_rate", "normalise_spline"});
  return {.combination = combination(value["combination"]),
          .spline_weight = number(value["spline_weight"]),
          .gauss_weight = number(value["gauss_weight"]),
          .laplace_weight = number(value["laplace_weight"]),
          .gauss_rate = number(value["gauss_rate"]),
          .laplace_rate = number(value["laplace_rate"]),
          .normalise_spline = flag(value["normalise_spline"])};
}

Regression::Regressor relevance_vectors(const json& value, Index dimensions) {
  require_members(value, {"kind", "kernel", "offset", "has_bias", "vectors", "weights",
                          "covariance", "noise_variance"});
  RelevanceVectorRegression::Model model;
  model.kernel = kernel(value["kernel"]);
  model.offset = number(value["offset"]);
  model.has_bias = flag(value["has_bias"]);
  model.vectors = matrix(value["vectors"], dimensions);
  model.weights = vector(value["weights"]);
  model.covariance = matrix(value["covariance"], model.weights.size());
  model.noise_variance = number(value["noise_variance"]);
  return sound(RelevanceVectorRegression::from_model(std::move(model)));
}

Regression::Regressor support_vectors(const json& value, Index dimensions) {
  require_members(value, {"kind", "gauss_rate", "bias", "vectors", "weights"});
  SupportVectorRegression::Model model;
  model.gauss_rate = number(value["gauss_rate"]);
  model.bias = number(value["bias"]);
  model.vectors = matrix(value["vectors"], dimensions);
  model.weights = vector(value["weights"]);
  return sound(SupportVectorRegression::from_model(std::move(model)));
}

Index dimensions_of(const json& value) {
  constexpr int kMaxDimensions = 1'000'000;
  const double read = number(value);
  if (!value.is_number_integer() || read < 1.0 || read > kMaxDimensions) {
    throw Unusable("dimensions is no usable count");
  }
  return value.get<Index>();
}

Regression regression(const json& value) {
  if (!value.is_object() || value.value("format", json()) != kFormat) {
    throw Unusable("this is no saved regression");
  }
  if (value.value("version", json()) != kVersion) throw Unusable("its version is unknown");
  require_members(value, {"format", "version", "dimensions", "scaler", "outputs"});
  const Index dimensions = dimensions_of(value["dimensions"]);
  std::vector<Regression::Regressor> outputs;
  require_list(value["outputs"]);
  for (const json& output : value["outputs"]) {
    const json kind = output.is_object() ? output.value("kind", json()) : json();
    if (kind != kRelevance && kind != kSupport) throw Unusable("a kind of regressor is unknown");
    outputs.push_back(kind == kRelevance ? relevance_vectors(output, dimensions)
                                         : support_vectors(output, dimensions));
  }
  return sound(Regression::from_parts(scaler(value["scaler"]), std::move(outputs)));
}

}  // namespace

std::string format_model(const Regression& regression) {
  json outputs = json::array();
  for (const Regression::Regressor& output : regression.outputs()) {
    outputs.push_back(std::visit([](const auto& one) { return to_json(one); }, output));
  }
  const json model{{"format", kFormat},
                   {"version", kVersion},
                   {"dimensions", regression.dimensions()},
                   {"scaler", to_json(regression.scaler())},
                   {"outputs", std::move(outputs)}};
  return model.dump() + "\n";
}

core::Result<Regression> parse_model(std::string_view text, std::string_view place) {
  constexpr ErrorCode kCode = ErrorCode::kBundleCorrupt;
  try {
    return regression(json::parse(text));
  } catch (const json::parse_error& error) {
    return core::fail(kCode, "not valid JSON; restore the model or train it again",
                      std::string(place) + " at byte " + std::to_string(error.byte));
  } catch (const json::exception&) {
    return core::fail(kCode, "a value is of the wrong kind; restore the model or train it again",
                      std::string(place));
  } catch (const Unusable& error) {
    return core::fail(kCode, std::string(error.what()) + "; restore the model or train it again",
                      std::string(place));
  }
}

}  // namespace waylode::learn
