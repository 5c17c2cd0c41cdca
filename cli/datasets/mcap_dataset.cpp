// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/mcap_dataset.hpp"

#include "datasets/split.hpp"
#include "datasets/test_recording.hpp"

namespace waylode::cli {

core::Result<Dataset> load_log_dataset(std::shared_ptr<const site::Site> site,
                                       const std::vector<std::filesystem::path>& logs,
                                       const DatasetContext& context) {
  auto model = pipeline::Model::create(site, context.options);
  if (!model) return tl::unexpected(model.error());
  Dataset dataset{"mcap", false, {}};
  for (const std::filesystem::path& path : logs) {
    TestCase test;
    test.name = recording_name(path);
    test.model = *model;
    test.load = [path, site] { return load_marked_log(path, *site, std::nullopt); };
    auto named = name_by_floor(std::move(test), path, site->name());
    if (!named) return tl::unexpected(named.error());
    dataset.tests.push_back(*std::move(named));
    if (context.progress) context.progress(dataset.tests.size(), logs.size());
  }
  return dataset;
}

}  // namespace waylode::cli
