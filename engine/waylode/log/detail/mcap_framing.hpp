// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace waylode::log::detail {

/// Cuts a stream of MCAP bytes into records, wherever the pieces end, with one record in memory.
class McapFraming {
 public:
  /// Where the stream stands between records.
  struct Position {
    std::uint64_t offset = 0;       ///< Of the record's first byte in the file.
    std::uint32_t section_crc = 0;  ///< Of the bytes from the section's start up to there.
  };
  struct Handler {
    /// Whether the content is wanted; what is not wanted is passed over without being kept.
    std::function<bool(std::uint8_t opcode, std::uint64_t size)> is_wanted;
    std::function<void(std::uint8_t opcode, std::string_view content, const Position&)> take;
    /// Reasons: "not_mcap", "unsupported_version", "bad_framing", "bytes_after_end".
    std::function<void(const char* reason)> reject;
  };

  explicit McapFraming(Handler handler) : handler_(std::move(handler)) {}

  void feed(std::string_view bytes);

  /// How far the file came: nullopt when it is complete, else what is missing, with the place.
  std::optional<std::string> shortage() const;

  /// The record that the file ends inside, as far as it was wanted.
  struct Partial {
    std::uint8_t opcode = 0;
    std::string_view content;
  };
  std::optional<Partial> partial() const;

 private:
  enum class State : std::uint8_t {
    kMagic,
    kPrefix,
    kContent,
    kSkip,
    kEndMagic,
    kEnd,
    kOverrun,
    kLost
  };

  /// The next `wanted_` bytes once they are all there, taken from `bytes`.
  std::optional<std::string_view> gather(std::string_view& bytes);
  void step(std::string_view part);
  void open_record(std::string_view prefix);
  void close_record(std::string_view content);
  void skip(std::string_view& bytes);
  void expect(State state, std::uint64_t size);
  void give_up(const char* reason);

  Handler handler_;
  State state_ = State::kMagic;
  std::uint64_t wanted_ = 8;  ///< Bytes of the part that the state waits for; for kSkip, left over.
  std::string pending_;       ///< What has come of it.
  bool pending_given_ = false;  ///< pending_ was handed out whole and is to be cleared.
  std::uint64_t offset_ = 0;    ///< Of the byte that follows all gathered parts.
  std::uint32_t crc_ = 0;       ///< Since the section's start, like offset_.
  std::uint8_t opcode_ = 0;
  Position record_;
};

}  // namespace waylode::log::detail
