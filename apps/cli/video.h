// Frames into a video file, through the ffmpeg program.
#pragma once

#include "output_file.h"
#include "picture.h"

#include <memory>
#include <string>

namespace elastoon {

/// .mp4 (H.264), .webm (VP9) or .gif, by the ending of the path. Nothing is left of a file that is not finished.
class VideoWriter {
public:
    /// Starts `program`, which is ffmpeg but in tests. The size must suit videoSize().
    static Result<VideoWriter> create(const std::string& path, PictureSize size, double fps,
                                      const std::string& program = "ffmpeg");
    VideoWriter(VideoWriter&&) noexcept;
    VideoWriter& operator=(VideoWriter&&) = delete;
    /// Ends ffmpeg and removes its file unless finish() was called.
    ~VideoWriter();

    /// Adds a frame.
    Status write(const Picture& picture);
    /// Waits for ffmpeg and puts the file in its place.
    Status finish();

private:
    struct Impl;
    explicit VideoWriter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The ending of the path in lower case, with its dot.
[[nodiscard]] std::string endingOf(const std::string& path);

/// Whether the path ends like a video that can be written.
[[nodiscard]] bool isVideoPath(const std::string& path);

/// The size that a video of this kind can have: .mp4 and .webm take even sizes only, so an odd one loses a row or
/// column.
[[nodiscard]] PictureSize videoSize(const std::string& path, PictureSize size);

} // namespace elastoon
