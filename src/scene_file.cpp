// Reading a scene from a file: apart from the reader, which needs no file system. See scene.h.
#include "elastoon/scene.h"

#include <fstream>
#include <sstream>

namespace elastoon {

namespace {

constexpr double kMostFileBytes = 256e6;

} // namespace

Result<Scene> readScene(const std::string& file, const MeshReader& read_mesh) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) {
        return Error{"cannot be read; is the path right?", file};
    }
    if (!(static_cast<double>(stream.tellg()) >= 0.0 && static_cast<double>(stream.tellg()) <= kMostFileBytes)) {
        return Error{"is not a scene file (a folder, or larger than 256 MB)", file};
    }
    stream.seekg(0);
    std::ostringstream text;
    text << stream.rdbuf();
    if (stream.bad()) {
        return Error{"cannot be read", file};
    }
    return parseScene(text.str(), file, read_mesh);
}

} // namespace elastoon
