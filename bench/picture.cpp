#include "picture.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include "hlod/core/error.h"

namespace hlodbench {

void writePicture(const std::filesystem::path& path, const Image& image) {
  const auto file = OIIO::ImageOutput::create(path.string());
  if (!file) throw InputError(fmt::format("{}: {}", path.string(), OIIO::geterror()));
  // colour only: alpha tells where something was drawn, not how opaque it is
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  constexpr OIIO::stride_t kPixel = 4;
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.tmp", ::getpid());
  std::error_code error;
  if (!file->open(temporary.string(), spec) ||
      !file->write_image(OIIO::TypeDesc::UINT8, image.pixels.data(), kPixel) || !file->close()) {
    const std::string reason = file->geterror();
    std::filesystem::remove(temporary, error);
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), reason));
  }
  std::filesystem::rename(temporary, path, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
}

}  // namespace hlodbench
