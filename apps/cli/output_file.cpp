// See output_file.h.
#include "output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace elastoon {

Result<OutputFile> OutputFile::create(const std::string& path) {
    namespace fs = std::filesystem;
    const fs::path target(path);
    std::error_code failure;
    if (target.filename().empty() || fs::is_directory(target, failure)) {
        return Error{"is a folder; give the name of a file", path};
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    fs::create_directories(folder, failure);
    if (failure) {
        return Error{fmt::format("cannot make the folder: {}", failure.message()), folder.string()};
    }
    const fs::path temporary =
        folder / fmt::format(".{}.{}{}", target.stem().string(), getpid(), target.extension().string());
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (file == nullptr) {
        return Error{fmt::format("cannot write: {}", std::strerror(errno)), path};
    }
    std::fclose(file);
    return OutputFile(path, temporary.string());
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}

OutputFile::~OutputFile() {
    if (!temporary_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(temporary_, ignored);
    }
}

Status OutputFile::commit() {
    std::error_code failure;
    std::filesystem::rename(temporary_, path_, failure);
    if (failure) {
        return Error{fmt::format("cannot put the file in its place: {}", failure.message()), path_};
    }
    temporary_.clear();
    return success();
}

Status writeWhole(const std::string& path, std::string_view bytes) {
    auto output = OutputFile::create(path);
    if (!output) {
        return output.error();
    }
    std::ofstream stream(output.value().temporaryPath(), std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) {
        return Error{"cannot write: is the disk full?", path};
    }
    return output.value().commit();
}

} // namespace elastoon
