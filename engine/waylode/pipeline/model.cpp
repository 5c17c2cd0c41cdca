// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/model.hpp"

#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "waylode/core/assert.hpp"
#include "waylode/radio/circle_knn.hpp"
#include "waylode/radio/knn_positioner.hpp"
#include "waylode/radio/reference_map.hpp"
#include "waylode/radio/region_wknn.hpp"
#include "waylode/radio/regression_positioner.hpp"
#include "waylode/radio/window_knn.hpp"

namespace waylode::pipeline {
namespace {

using PositionerPtr = std::shared_ptr<const radio::Positioner>;

}  // namespace

/// What is made on demand, under one lock: making something twice would cost more than waiting.
struct Model::Shared {
  std::mutex mutex;
  std::optional<radio::HotspotClassifier> hotspots;
  std::optional<radio::ReferenceMap> references;
  std::map<RadioPart, PositionerPtr> positioners;
  PositionerPtr near;
  std::optional<radio::PlaceLikelihood> places;
  std::shared_ptr<const std::vector<magnetic::FieldGrid>> fields;
  fusion::Terrain terrain;

  core::Result<const radio::ReferenceMap*> reference_map(const Model& model) {
    if (!references) {
      auto map = radio::ReferenceMap::create(model.site()->radio_map(), model.options().references);
      if (!map) return tl::unexpected(map.error());
      references = *std::move(map);
    }
    return &*references;
  }
  core::Result<PositionerPtr> make(RadioPart part, const Model& model);
};

core::Result<PositionerPtr> Model::Shared::make(RadioPart part, const Model& model) {
  const Options& options = model.options();
  if (part == RadioPart::kWknn) {
    return std::make_shared<radio::WknnPositioner>(
        radio::WknnEstimator(model.matcher(), options.wknn));
  }
  const auto map = reference_map(model);
  if (!map) return tl::unexpected(map.error());
  switch (part) {
    case RadioPart::kKnn:
      return std::make_shared<radio::KnnPositioner>(**map, options.knn);
    case RadioPart::kRegionWknn:
      return std::make_shared<radio::RegionWknn>(**map, options.region);
    case RadioPart::kWindowKnn:
      return std::make_shared<radio::WindowKnn>(**map, options.window);
    default:
      break;
  }
  WAYLODE_ASSERT(part == RadioPart::kRelevanceVectors || part == RadioPart::kSupportVectors);
  using Regression = radio::RegressionPositioner;
  Regression::Options regression = options.regression;
  regression.kind = part == RadioPart::kRelevanceVectors ? Regression::Kind::kRelevanceVectors
                                                         : Regression::Kind::kSupportVectors;
  auto trained = Regression::create(**map, regression);
  if (!trained) return tl::unexpected(trained.error());
  return std::make_shared<Regression>(*std::move(trained));
}

Model::Model(std::shared_ptr<const site::Site> site, const Options& options, radio::Matcher matcher)
    : site_(std::move(site)),
      options_(options),
      matcher_(std::move(matcher)),
      shared_(std::make_unique<Shared>()) {}
Model::~Model() = default;

core::Result<std::shared_ptr<const Model>> Model::create(std::shared_ptr<const site::Site> site,
                                                         const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (site->radio_map().empty()) {
    return core::fail(core::ErrorCode::kMapMissing,
                      "the site has no radio map; build it from surveyed logs", site->name());
  }
  auto matcher = radio::Matcher::create(site->radio_map(), options.matcher);
  if (!matcher) return tl::unexpected(matcher.error());
  return std::shared_ptr<const Model>(new Model(std::move(site), options, *std::move(matcher)));
}

core::Result<void> Model::prepare(const Method& method) const {
  if (method.recipe.radio != RadioPart::kNone) {
    if (auto made = positioner(method.recipe.radio); !made) return tl::unexpected(made.error());
  }
  if (method.recipe.magnetic == MagneticPart::kSequence) {
    if (auto made = fields(); !made) return tl::unexpected(made.error());
  }
  return {};
}

core::Result<PositionerPtr> Model::positioner(RadioPart part) const {
  const std::scoped_lock lock(shared_->mutex);
  PositionerPtr& made = shared_->positioners[part];
  if (!made) {
    auto fresh = shared_->make(part, *this);
    if (!fresh) return fresh;
    made = *std::move(fresh);
  }
  return made;
}

core::Result<PositionerPtr> Model::near_positioner() const {
  const std::scoped_lock lock(shared_->mutex);
  if (!shared_->near) {
    const auto map = shared_->reference_map(*this);
    if (!map) return tl::unexpected(map.error());
    shared_->near = std::make_shared<radio::CircleKnn>(**map, options_.circle);
  }
  return shared_->near;
}

const radio::HotspotClassifier& Model::hotspots() const {
  const std::scoped_lock lock(shared_->mutex);
  if (!shared_->hotspots) shared_->hotspots.emplace();
  return *shared_->hotspots;
}

core::Result<const radio::ReferenceMap*> Model::reference_map() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->reference_map(*this);
}

core::Result<const radio::PlaceLikelihood*> Model::places() const {
  const std::scoped_lock lock(shared_->mutex);
  if (!shared_->places) {
    auto made = radio::PlaceLikelihood::create(matcher_, options_.places);
    if (!made) return tl::unexpected(made.error());
    shared_->places = *std::move(made);
  }
  return &*shared_->places;
}

fusion::Terrain Model::terrain() const {
  const std::scoped_lock lock(shared_->mutex);
  fusion::Terrain& terrain = shared_->terrain;
  if (terrain.walkability) return terrain;
  std::vector<site::Walkability> walkability;
  std::vector<magnetic::FieldLikelihood> fields;
  const site::MagneticMap map = site_->magnetic_map();
  for (std::size_t i = 0; i < site_->floors().size(); ++i) {
    const site::Floor& floor = site_->floors()[i];
    walkability.emplace_back(floor.plan, floor.bounds, options_.walkability);
    const core::FloorId id{static_cast<std::uint16_t>(i)};
    if (!map.empty()) fields.emplace_back(map.on_floor(id), options_.field.guesses);
  }
  terrain.walkability =
      std::make_shared<const std::vector<site::Walkability>>(std::move(walkability));
  if (!map.empty()) {
    terrain.fields =
        std::make_shared<const std::vector<magnetic::FieldLikelihood>>(std::move(fields));
  }
  return terrain;
}

core::Result<std::shared_ptr<const std::vector<magnetic::FieldGrid>>> Model::fields() const {
  const std::scoped_lock lock(shared_->mutex);
  if (site_->magnetic_map().empty()) {
    return core::fail(core::ErrorCode::kMapMissing,
                      "the site has no magnetic map, which this method needs; build the site again "
                      "from surveys with magnetometer records",
                      site_->name());
  }
  if (!shared_->fields) {
    shared_->fields = std::make_shared<const std::vector<magnetic::FieldGrid>>(
        magnetic::field_grids(site_->magnetic_map(), site_->floors().size(), options_.field.grid));
  }
  return shared_->fields;
}

}  // namespace waylode::pipeline
