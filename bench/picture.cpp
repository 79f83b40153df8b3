#include "picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "hlod/core/error.h"
#include "metrics/text_file.h"

namespace hlodbench {

void writePicture(const std::filesystem::path& path, const Image& image) {
  const auto file = OIIO::ImageOutput::create(path.string());
  if (!file) throw InputError(fmt::format("{}: {}", path.string(), OIIO::geterror()));
  // colour only: alpha tells where something was drawn, not how opaque it is
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  constexpr OIIO::stride_t kPixel = 4;
  // into memory first: the library does not notice when a disk is full
  OIIO::Filesystem::IOVecOutput memory;
  if (!file->set_ioproxy(&memory) || !file->open(path.string(), spec) ||
      !file->write_image(OIIO::TypeDesc::UINT8, image.pixels.data(), kPixel) || !file->close())
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), file->geterror()));
  const auto& bytes = memory.buffer();
  writeTextFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace hlodbench
