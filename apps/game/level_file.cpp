// Levels from a file; WebAssembly has none.
#include "level.h"

#include <fstream>
#include <sstream>

namespace squashout {

elastoon::Result<std::vector<Level>> readLevels(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream) {
        return elastoon::Error{"cannot be read", file};
    }
    return parseLevels(text.str(), file);
}

} // namespace squashout
