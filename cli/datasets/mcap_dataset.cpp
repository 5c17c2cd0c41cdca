// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/mcap_dataset.hpp"

#include "datasets/test_recording.hpp"

namespace waylode::cli {

core::Result<Dataset> load_log_dataset(std::shared_ptr<const site::Site> site,
                                       const std::vector<std::filesystem::path>& logs,
                                       const DatasetContext& context) {
  auto model = pipeline::Model::create(site, context.options);
  if (!model) return tl::unexpected(model.error());
  Dataset dataset{"mcap", false, {}, {}};
  for (const std::filesystem::path& path : logs) {
    auto test = make_log_test(path, *model, site->name(), context.log);
    if (!test) return tl::unexpected(test.error());
    dataset.tests.push_back(*std::move(test));
    if (context.progress) context.progress(dataset.tests.size(), logs.size());
  }
  return dataset;
}

}  // namespace waylode::cli
