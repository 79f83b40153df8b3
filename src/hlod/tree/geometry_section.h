#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hlod/tree/file_mapping.h"

namespace hlodbench {

// The geometry of all nodes: bytes of its own, or a part of a mapped file.
class GeometrySection {
 public:
  GeometrySection() = default;
  explicit GeometrySection(std::vector<std::byte> own) : own_(std::move(own)) {}
  // offset + size must lie within the mapping.
  GeometrySection(std::shared_ptr<const FileMapping> mapping, std::size_t offset, std::size_t size)
      : mapping_(std::move(mapping)), mapped_(mapping_->bytes().subspan(offset, size)) {}

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return mapping_ != nullptr ? mapped_ : std::span<const std::byte>(own_);
  }
  // What messages call it: the file, or "hierarchy".
  [[nodiscard]] std::string name() const {
    return mapping_ != nullptr ? mapping_->path().string() : "hierarchy";
  }

 private:
  std::vector<std::byte> own_;
  std::shared_ptr<const FileMapping> mapping_;
  std::span<const std::byte> mapped_;
};

}  // namespace hlodbench
