// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/model_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "waylode/core/rng.hpp"

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

/// The first output of relevance vectors, the second of support vectors, both of 3 dimensions.
Regression mixed_regression() {
  core::Rng rng(2);
  MatrixXd inputs(12, 3);
  VectorXd targets(12);
  for (int i = 0; i < 12; ++i) {
    for (int d = 0; d < 3; ++d) inputs(i, d) = rng.uniform();
    targets(i) = inputs(i, 0) - 2.0 * inputs(i, 2) + 0.1 * rng.normal();
  }
  RelevanceVectorRegression::Options options;
  options.kernel.combination = Kernel::Combination::kProduct;
  options.kernel.normalise_spline = true;
  return *Regression::from_parts(*InputScaler::from_range(-95.5, 60.25, {.clip_low = -0.15}),
                                 {*RelevanceVectorRegression::train(inputs, targets, options),
                                  *SupportVectorRegression::train(inputs, targets, {})});
}

std::string changed(const json::json_pointer& where, const json& value) {
  json model = json::parse(format_model(mixed_regression()));
  model[where] = value;
  return model.dump();
}

void expect_refused(std::string_view text) {
  const auto read = parse_model(text, "x.json");
  ASSERT_FALSE(read) << text;
  EXPECT_EQ(read.error().code, core::ErrorCode::kBundleCorrupt);
  EXPECT_EQ(read.error().place.substr(0, 6), "x.json");
}

TEST(ModelFile, GivesBackTheSameRegression) {
  const Regression regression = mixed_regression();
  const std::string text = format_model(regression);
  const auto read = parse_model(text, "x.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(format_model(*read), text);
  EXPECT_EQ(read->scaler(), regression.scaler());
  const MatrixXd inputs{{-90.0, -70.0, -40.0}, {-55.0, -61.0, -83.0}};
  EXPECT_EQ(read->predict(inputs)->mean, regression.predict(inputs)->mean);
  const auto& before = std::get<RelevanceVectorRegression>(regression.outputs()[0]);
  const auto& after = std::get<RelevanceVectorRegression>(read->outputs()[0]);
  ASSERT_GT(before.vector_count(), 0U);
  EXPECT_EQ(after.model().covariance, before.model().covariance);
  EXPECT_EQ(after.model().kernel, before.model().kernel);
  EXPECT_EQ(after.predict(inputs / -100.0)->sigma, before.predict(inputs / -100.0)->sigma);
}

TEST(ModelFile, KeepsTheDimensionsOfAModelWithoutVectors) {
  const auto constant =
      RelevanceVectorRegression::train(MatrixXd::Random(5, 4), VectorXd::Constant(5, 2.5), {});
  ASSERT_TRUE(constant);
  ASSERT_EQ(constant->vector_count(), 0U);
  const auto regression =
      Regression::from_parts(*InputScaler::from_range(0.0, 1.0, {}), {*constant});
  const auto read = parse_model(format_model(*regression), "x.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->dimensions(), 4);
  EXPECT_EQ(read->predict(MatrixXd::Zero(1, 4))->mean(0, 0), 2.5);
}

TEST(ModelFile, RefusesATextCutShortAnywhere) {
  const std::string text = format_model(mixed_regression());
  for (std::size_t size = 0; size + 2 < text.size(); size += 7) {
    expect_refused(std::string_view(text).substr(0, size));
  }
}

TEST(ModelFile, RefusesOtherFormatsAndVersions) {
  expect_refused("");
  expect_refused("null");
  expect_refused("[]");
  expect_refused("{}");
  expect_refused(changed(json::json_pointer("/format"), "something else"));
  expect_refused(changed(json::json_pointer("/version"), 2));
  expect_refused(changed(json::json_pointer("/version"), "1"));
}

TEST(ModelFile, RefusesMembersThatAreUnknownOrMissing) {
  for (const char* where :
       {"/more", "/scaler/more", "/outputs/0/more", "/outputs/1/more", "/outputs/0/kernel/more"}) {
    expect_refused(changed(json::json_pointer(where), 1));
  }
  const json model = json::parse(format_model(mixed_regression()));
  for (const char* where : {"", "/scaler", "/outputs/0", "/outputs/0/kernel", "/outputs/1"}) {
    const json::json_pointer pointer(where);
    for (const auto& [name, value] : model[pointer].items()) {
      json lacking = model;
      lacking[pointer].erase(name);
      expect_refused(lacking.dump());
    }
  }
}

TEST(ModelFile, RefusesValuesOfTheWrongKindOrRange) {
  const std::pair<const char*, json> damages[] = {
      {"/dimensions", 2},
      {"/dimensions", 0},
      {"/dimensions", 3.0},
      {"/dimensions", -3},
      {"/dimensions", 1e12},
      {"/dimensions", "3"},
      {"/scaler", json::array()},
      {"/scaler/span", 0.0},
      {"/scaler/low", nullptr},
      {"/scaler/clip_high", 0.5},
      {"/outputs", json::array()},
      {"/outputs", json::object()},
      {"/outputs/0", 7},
      {"/outputs/0/kind", "oracle"},
      {"/outputs/0/kernel/combination", "ratio"},
      {"/outputs/0/kernel/gauss_rate", -1.0},
      {"/outputs/0/kernel/normalise_spline", 1},
      {"/outputs/0/offset", "0"},
      {"/outputs/0/noise_variance", 0.0},
      {"/outputs/0/noise_variance", -0.1},
      {"/outputs/0/has_bias", 0},
      {"/outputs/0/vectors", json::array()},
      {"/outputs/0/vectors/0", json::array({1.0, 2.0})},
      {"/outputs/0/vectors/0/1", true},
      {"/outputs/0/weights", json::array({1.0})},
      {"/outputs/0/weights/0", json::array()},
      {"/outputs/0/covariance", json::array()},
      {"/outputs/0/covariance/0/0", -1e9},
      {"/outputs/1/gauss_rate", 0.0},
      {"/outputs/1/bias", nullptr},
      {"/outputs/1/weights", json::array()},
      {"/outputs/1/vectors/0", "row"},
  };
  for (const auto& [where, value] : damages) {
    expect_refused(changed(json::json_pointer(where), value));
  }
}

TEST(ModelFile, RefusesNumbersThatAreNotFinite) {
  std::string text = format_model(mixed_regression());
  const std::string key = "\"bias\":";
  const std::size_t begin = text.find(key) + key.size();
  const std::size_t end = text.find_first_of(",}", begin);
  for (const char* value : {"1e999", "NaN", "Infinity", "-1e999"}) {
    expect_refused(std::string(text).replace(begin, end - begin, value));
  }
}

}  // namespace
}  // namespace waylode::learn
