// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/mcap_framing.hpp"

#include <algorithm>

#include "waylode/log/detail/mcap_bytes.hpp"

namespace waylode::log::detail {
namespace {

/// The magic's octet that holds the major version.
constexpr std::size_t kVersionPlace = 5;

bool is_magic_of_other_version(std::string_view magic) {
  std::string same(magic);
  same[kVersionPlace] = kMcapMagic[kVersionPlace];
  return same == kMcapMagic;
}

}  // namespace

void McapFraming::feed(std::string_view bytes) {
  while (!bytes.empty()) {
    if (state_ == State::kLost || state_ == State::kOverrun) return;
    if (state_ == State::kEnd) {
      state_ = State::kOverrun;
      return handler_.reject("bytes_after_end");
    }
    if (state_ == State::kSkip) {
      skip(bytes);
    } else if (const auto part = gather(bytes)) {
      step(*part);
    }
  }
}

std::optional<std::string_view> McapFraming::gather(std::string_view& bytes) {
  if (pending_given_) pending_.clear();
  pending_given_ = false;
  const std::size_t missing = static_cast<std::size_t>(wanted_) - pending_.size();
  if (bytes.size() < missing) {
    pending_.append(bytes);
    bytes = {};
    return std::nullopt;
  }
  std::string_view part = bytes.substr(0, missing);
  bytes.remove_prefix(missing);
  if (!pending_.empty()) {
    pending_.append(part);
    pending_given_ = true;
    part = pending_;
  }
  return part;
}

void McapFraming::step(std::string_view part) {
  const std::uint32_t crc_before = crc_;
  crc_ = crc_of(part, crc_);
  offset_ += part.size();
  switch (state_) {
    case State::kMagic:
      if (part == kMcapMagic) return expect(State::kPrefix, kRecordPrefixBytes);
      return give_up(is_magic_of_other_version(part) ? "unsupported_version" : "not_mcap");
    case State::kPrefix:
      record_ = {offset_ - part.size(), crc_before};
      return open_record(part);
    case State::kContent:
      return close_record(part);
    case State::kEndMagic:
      if (part == kMcapMagic) return expect(State::kEnd, 0);
      return give_up("bad_framing");
    default:
      return;
  }
}

void McapFraming::open_record(std::string_view prefix) {
  ByteReader reader(prefix);
  opcode_ = reader.take<std::uint8_t>().value_or(0);
  const std::uint64_t size = reader.take<std::uint64_t>().value_or(0);
  const bool is_footer = opcode_ == static_cast<std::uint8_t>(Opcode::kFooter);
  if (opcode_ == 0 || (is_footer && size != kFooterBytes)) return give_up("bad_framing");
  const bool is_wanted = handler_.is_wanted(opcode_, size);
  expect(is_wanted || is_footer ? State::kContent : State::kSkip, size);
  // Parts without bytes never come by feed.
  if (size == 0 && state_ == State::kContent) return close_record({});
  if (size == 0) expect(State::kPrefix, kRecordPrefixBytes);
}

void McapFraming::close_record(std::string_view content) {
  const auto opcode = static_cast<Opcode>(opcode_);
  handler_.take(opcode_, content, record_);
  if (opcode == Opcode::kDataEnd) crc_ = 0;  // The summary section begins.
  if (opcode == Opcode::kFooter) return expect(State::kEndMagic, kMcapMagic.size());
  expect(State::kPrefix, kRecordPrefixBytes);
}

void McapFraming::skip(std::string_view& bytes) {
  const std::size_t count = std::min<std::uint64_t>(wanted_, bytes.size());
  crc_ = crc_of(bytes.substr(0, count), crc_);
  offset_ += count;
  wanted_ -= count;
  bytes.remove_prefix(count);
  if (wanted_ == 0) expect(State::kPrefix, kRecordPrefixBytes);
}

void McapFraming::expect(State state, std::uint64_t size) {
  state_ = state;
  wanted_ = size;
}

void McapFraming::give_up(const char* reason) {
  offset_ = record_.offset;
  state_ = State::kLost;
  handler_.reject(reason);
}

std::optional<std::string> McapFraming::shortage() const {
  const std::string place = "at byte " + std::to_string(offset_) + ": ";
  switch (state_) {
    case State::kEnd:
    case State::kOverrun:
      return std::nullopt;
    case State::kLost:
      return place + "the framing is damaged; nothing after it was read";
    case State::kContent:
    case State::kSkip:
      return "at byte " + std::to_string(record_.offset) + ": the file ends inside a record";
    default:
      return place + "the file ends without its footer";
  }
}

std::optional<McapFraming::Partial> McapFraming::partial() const {
  if (state_ != State::kContent) return std::nullopt;
  const bool has_begun = !pending_given_;
  return Partial{opcode_, has_begun ? std::string_view(pending_) : std::string_view()};
}

}  // namespace waylode::log::detail
