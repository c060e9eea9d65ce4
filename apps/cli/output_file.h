// A file that appears whole or not at all: written beside its place under another name, then renamed.
#pragma once

#include "elastoon/result.h"

#include <string>
#include <string_view>

namespace elastoon {

class OutputFile {
public:
    /// Checks that the folder can be written, and makes the temporary file.
    static Result<OutputFile> create(const std::string& path);
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    /// Removes the temporary file unless commit() was called.
    ~OutputFile();

    /// Where to write; same ending as the final path.
    [[nodiscard]] const std::string& temporaryPath() const { return temporary_; }
    /// Puts the file in its place.
    Status commit();

private:
    OutputFile(std::string path, std::string temporary) : path_(std::move(path)), temporary_(std::move(temporary)) {}
    std::string path_, temporary_;
};

/// Writes `bytes` to `path` through an OutputFile.
Status writeWhole(const std::string& path, std::string_view bytes);

} // namespace elastoon
