// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "waylode/core/atomic_file_writer.hpp"

namespace waylode::core {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

tl::unexpected<Error> fail_reading(const std::filesystem::path& path, int error_number) {
  if (error_number == ENOENT || error_number == ENOTDIR) {
    return fail(ErrorCode::kFileNotFound, "no such file; check the path", path.string());
  }
  return fail(ErrorCode::kFileUnreadable,
              std::string("cannot be read (") + std::strerror(error_number) + ")", path.string());
}

/// Opens a regular file for reading and tells its size.
Result<std::pair<int, std::size_t>> open_regular(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return fail_reading(path, errno);
  struct stat status{};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    const int error_number = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    ::close(descriptor);
    return fail_reading(path, error_number);
  }
  return std::pair(descriptor, static_cast<std::size_t>(status.st_size));
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  const auto opened = open_regular(path);
  if (!opened) return tl::unexpected(opened.error());
  const FileDescriptor file(opened->first);
  std::string bytes(opened->second, '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail_reading(path, errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  return AtomicFileWriter::create(path).and_then([bytes](AtomicFileWriter&& writer) {
    return writer.write(bytes).and_then([&writer] { return writer.commit(); });
  });
}

Result<MemoryMappedFile> MemoryMappedFile::open(const std::filesystem::path& path) {
  const auto opened = open_regular(path);
  if (!opened) return tl::unexpected(opened.error());
  const FileDescriptor file(opened->first);
  const std::size_t size = opened->second;
  if (size == 0) return MemoryMappedFile(std::span<const std::byte>{});
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (address == MAP_FAILED) return fail_reading(path, errno);
  return MemoryMappedFile(std::span(static_cast<const std::byte*>(address), size));
}

MemoryMappedFile::MemoryMappedFile(MemoryMappedFile&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})) {}

MemoryMappedFile& MemoryMappedFile::operator=(MemoryMappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MemoryMappedFile::~MemoryMappedFile() {
  if (bytes_.empty()) return;
  ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());  // NOLINT: munmap takes void*.
}

}  // namespace waylode::core
