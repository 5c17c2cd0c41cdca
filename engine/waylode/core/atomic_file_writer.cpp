// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/atomic_file_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace waylode::core {
namespace {

tl::unexpected<Error> fail_writing(const std::filesystem::path& path, int error_number) {
  const char* remedy = error_number == ENOSPC ? "; free some space" : "; check folder and rights";
  return fail(ErrorCode::kFileUnwritable,
              std::string("cannot be written (") + std::strerror(error_number) + ")" + remedy,
              path.string());
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<AtomicFileWriter> AtomicFileWriter::create(const std::filesystem::path& path) {
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) return fail_writing(path, errno);
  return AtomicFileWriter(path, std::move(temporary), descriptor);
}

AtomicFileWriter::AtomicFileWriter(std::filesystem::path path, std::string temporary,
                                   int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

AtomicFileWriter::AtomicFileWriter(AtomicFileWriter&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFileWriter& AtomicFileWriter::operator=(AtomicFileWriter&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(temporary_, other.temporary_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AtomicFileWriter::~AtomicFileWriter() { discard(); }

Result<void> AtomicFileWriter::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes)) return fail_and_discard(errno);
  return {};
}

Result<void> AtomicFileWriter::commit() {
  constexpr mode_t kEveryoneReads = 0644;
  if (::fchmod(descriptor_, kEveryoneReads) != 0 || ::fsync(descriptor_) != 0 ||
      ::rename(temporary_.c_str(), path_.c_str()) != 0) {
    return fail_and_discard(errno);
  }
  ::close(std::exchange(descriptor_, -1));
  return {};
}

void AtomicFileWriter::discard() {
  if (descriptor_ < 0) return;
  ::unlink(temporary_.c_str());
  ::close(std::exchange(descriptor_, -1));
}

Result<void> AtomicFileWriter::fail_and_discard(int error_number) {
  discard();
  return fail_writing(path_, error_number);
}

}  // namespace waylode::core
