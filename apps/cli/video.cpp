// See video.h.
#include "video.h"

#include "progress.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace elastoon {

namespace {

enum class Kind : std::uint8_t { Mp4, Webm, Gif, None };

Kind kindOf(const std::string& path) {
    const std::string ending = endingOf(path);
    return ending == ".mp4" ? Kind::Mp4 : ending == ".webm" ? Kind::Webm : ending == ".gif" ? Kind::Gif : Kind::None;
}

/// What ffmpeg is told. Everything that would make two runs differ is off; the thread count is part of that.
std::vector<std::string> argumentsFor(const std::string& program, Kind kind, PictureSize size, double fps,
                                      const std::string& file) {
    std::vector<std::string> arguments{program, "-hide_banner", "-loglevel", "error", "-nostdin", "-y"};
    const auto add = [&](std::initializer_list<const char*> more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-s"});
    arguments.push_back(fmt::format("{}x{}", size.width, size.height));
    add({"-r"});
    arguments.push_back(fmt::format("{}", fps));
    add({"-i", "pipe:0", "-an", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads",
         "2"});
    if (kind == Kind::Gif) {
        add({"-filter_complex", "[0:v]split[a][b];[a]palettegen=stats_mode=full[p];"
                                "[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle"});
    } else {
        add({"-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p", "-colorspace", "bt709",
             "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    }
    if (kind == Kind::Mp4) {
        add({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"});
    } else if (kind == Kind::Webm) {
        add({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1"});
    }
    arguments.push_back(file);
    return arguments;
}

std::string lastLineOf(std::FILE* file) {
    if (std::fseek(file, 0, SEEK_SET) != 0) {
        return {};
    }
    std::string text(65536, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file));
    text.erase(text.find_last_not_of("\n\r ") + 1);
    const std::size_t line = text.find_last_of("\n\r");
    return line == std::string::npos ? text : text.substr(line + 1);
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

} // namespace

struct VideoWriter::Impl {
    std::string path;
    OutputFile output;
    std::unique_ptr<std::FILE, CloseFile> messages; ///< ffmpeg's standard error
    PictureSize size;
    pid_t process = -1;
    int frames_to = -1; ///< our end of the socket that ffmpeg reads

    Impl(std::string to, OutputFile file) : path(std::move(to)), output(std::move(file)) {}
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        closeFrames();
        if (process > 0) {
            kill(-process, SIGKILL);
            waitpid(process, nullptr, 0);
        }
    }

    void closeFrames() {
        if (frames_to >= 0) {
            close(frames_to);
            frames_to = -1;
        }
    }
    Status start(const std::vector<std::string>& arguments);
    [[nodiscard]] Error failure(const std::string& what) const;
    Status wait();
};

Error VideoWriter::Impl::failure(const std::string& what) const {
    const std::string line = messages ? lastLineOf(messages.get()) : std::string();
    return {line.empty() ? what : fmt::format("{}: {}", what, line), path};
}

Status VideoWriter::Impl::start(const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    messages.reset(std::tmpfile());
    // A socket, not a pipe: writing to a closed one can be asked not to raise SIGPIPE.
    if (!messages || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return Error{fmt::format("cannot start ffmpeg: {}", std::strerror(errno)), path};
    }
    frames_to = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(messages.get()), STDERR_FILENO);
    // A group of its own: Ctrl-C reaches us alone, and we end it in our own time.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t standard;
    sigemptyset(&standard);
    sigaddset(&standard, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &standard);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) {
        pointers.push_back(const_cast<char*>(argument.c_str())); // spawn's signature is older than const
    }
    pointers.push_back(nullptr);
    const int failed = posix_spawnp(&process, pointers[0], &actions, &attributes, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(ends[1]);
    if (failed != 0) {
        process = -1;
        const char* hint = failed == ENOENT ? "; install it (Debian: apt install ffmpeg)" : "";
        return Error{fmt::format("cannot run {}: {}{}", arguments[0], std::strerror(failed), hint), path};
    }
    return success();
}

Status VideoWriter::Impl::wait() {
    int state = 0;
    while (waitpid(process, &state, WNOHANG) == 0) {
        if (interrupted()) {
            return Error{"stopped", path};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    process = -1;
    if (!WIFEXITED(state) || WEXITSTATUS(state) != 0) {
        return failure("ffmpeg failed");
    }
    return success();
}

VideoWriter::VideoWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

Result<VideoWriter> VideoWriter::create(const std::string& path, PictureSize size, double fps,
                                        const std::string& program) {
    const Kind kind = kindOf(path);
    if (kind == Kind::None) {
        return Error{"is no video that can be written; end the name in .mp4, .webm or .gif", path};
    }
    if (videoSize(path, size) != size) {
        return Error{fmt::format("needs an even size, not {}x{}", size.width, size.height), path};
    }
    auto output = OutputFile::create(path);
    if (!output) {
        return output.error();
    }
    auto impl = std::make_unique<Impl>(path, std::move(output).value());
    impl->size = size;
    const auto started = impl->start(argumentsFor(program, kind, size, fps, impl->output.temporaryPath()));
    if (!started) {
        return started.error();
    }
    return VideoWriter(std::move(impl));
}

Status VideoWriter::write(const Picture& picture) {
    if (picture.size != impl_->size) {
        return Error{"the frame has another size than the video", impl_->path};
    }
    const std::vector<std::uint8_t> bytes = toRgb8(picture);
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t count = send(impl_->frames_to, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            const std::string reason = std::strerror(errno);
            impl_->closeFrames();
            const auto waited = impl_->wait();
            return waited ? impl_->failure(fmt::format("ffmpeg took no more frames ({})", reason)) : waited.error();
        }
        sent += static_cast<std::size_t>(count);
    }
    return success();
}

Status VideoWriter::finish() {
    impl_->closeFrames();
    const auto waited = impl_->wait();
    if (!waited) {
        return waited.error();
    }
    return impl_->output.commit();
}

std::string endingOf(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& letter : ending) {
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return ending;
}

bool isVideoPath(const std::string& path) {
    return kindOf(path) != Kind::None;
}

PictureSize videoSize(const std::string& path, PictureSize size) {
    const Kind kind = kindOf(path);
    if (kind == Kind::Mp4 || kind == Kind::Webm) {
        return {size.width / 2 * 2, size.height / 2 * 2};
    }
    return size;
}

} // namespace elastoon
