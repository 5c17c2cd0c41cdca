// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/byte_stream.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "waylode/log/detail/zstd_inflater.hpp"

namespace waylode::log::detail {
namespace {

constexpr std::size_t kChunkBytes = 256 * 1024;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

tl::unexpected<core::Error> fail_reading(const std::filesystem::path& path, int error_number) {
  if (error_number == ENOENT || error_number == ENOTDIR) {
    return core::fail(core::ErrorCode::kFileNotFound, "no such file; check the path",
                      path.string());
  }
  return core::fail(core::ErrorCode::kFileUnreadable,
                    std::string("cannot be read (") + std::strerror(error_number) +
                        "); check that it is a file and that you may read it",
                    path.string());
}

}  // namespace

core::Result<StreamTrouble> stream_file(const std::filesystem::path& path, const ChunkSink& sink) {
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) return fail_reading(path, errno);
  std::vector<char> buffer(kChunkBytes);
  ZstdInflater inflater;
  bool is_wanted = true;
  while (is_wanted) {
    const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get());
    if (count == 0 && std::ferror(file.get()) != 0) return fail_reading(path, errno);
    if (count == 0) break;
    is_wanted = inflater.feed({buffer.data(), count}, sink);
  }
  if (is_wanted) inflater.finish(sink);
  return inflater.trouble();
}

StreamTrouble stream_bytes(std::string_view bytes, const ChunkSink& sink) {
  ZstdInflater inflater;
  if (inflater.feed(bytes, sink)) inflater.finish(sink);
  return inflater.trouble();
}

}  // namespace waylode::log::detail
