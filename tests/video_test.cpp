// Videos: right kinds, the same bytes again, and nothing left of what fails or is stopped.
#include "progress.h"
#include "render.h"
#include "video.h"

#include "test_support.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace elastoon {
namespace {

namespace fs = std::filesystem;

class Video : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  ("elastoon_video_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] long entries() const { return std::distance(fs::directory_iterator(folder_), {}); }

    fs::path folder_;
};

bool hasFfmpeg() {
    return std::system("ffmpeg -version > /dev/null 2>&1") == 0;
}

std::string bytesOf(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Status writeFrames(const std::string& path, PictureSize size, int frames) {
    auto writer = VideoWriter::create(path, size, 10.0);
    if (!writer) {
        return writer.error();
    }
    for (int i = 0; i < frames; ++i) {
        const auto written = writer.value().write(makePicture(size, Color(0.1F * static_cast<float>(i), 0.3F, 0.5F)));
        if (!written) {
            return written.error();
        }
    }
    return writer.value().finish();
}

Scene smallScene() {
    return valueOf(parseScene(R"({"elastoon": 1, "name": "t", "duration": 0.5,
        "shapes": {"ball": {"type": "sphere", "radius": 0.5}},
        "bodies": [{"name": "a", "shape": "ball", "position": [0, 2, 0]}],
        "obstacles": [{"name": "floor", "type": "plane", "normal": [0, 1, 0], "offset": 0}],
        "strobe": {"every": 0.1}})"));
}

Timeline timelineOf(const Scene& scene) {
    StagedScene staged = valueOf(stage(scene));
    Timeline timeline;
    timeline.begin(staged.world);
    for (int i = 0; i < 30; ++i) {
        staged.world.step(1.0 / 60.0);
        timeline.capture(staged.world);
    }
    return timeline;
}

TEST_F(Video, EveryKindIsWrittenAndTwoRunsAgree) {
    if (!hasFfmpeg()) {
        GTEST_SKIP() << "ffmpeg is not installed";
    }
    const std::array<std::pair<const char*, std::string>, 3> kinds{
        {{".mp4", "ftyp"}, {".webm", "webm"}, {".gif", "GIF89a"}}};
    for (const auto& [ending, mark] : kinds) {
        const std::string a = file(std::string("a") + ending), b = file(std::string("b") + ending);
        const auto written = writeFrames(a, {64, 48}, 5);
        ASSERT_TRUE(written.ok()) << written.error().text();
        ASSERT_TRUE(writeFrames(b, {64, 48}, 5).ok());
        EXPECT_NE(bytesOf(a).substr(0, 64).find(mark), std::string::npos) << ending;
        EXPECT_EQ(bytesOf(a), bytesOf(b)) << ending;
    }
    EXPECT_EQ(entries(), 6);
}

TEST_F(Video, OddSizes) {
    EXPECT_EQ(videoSize("x.mp4", {65, 49}), (PictureSize{64, 48}));
    EXPECT_EQ(videoSize("x.WEBM", {64, 49}), (PictureSize{64, 48}));
    EXPECT_EQ(videoSize("x.gif", {65, 49}), (PictureSize{65, 49}));
    EXPECT_FALSE(VideoWriter::create(file("a.mp4"), {65, 48}, 10.0).ok());
    if (hasFfmpeg()) {
        EXPECT_TRUE(writeFrames(file("a.gif"), {65, 49}, 2).ok());
        const Scene scene = smallScene();
        VideoOptions options;
        options.size = {67, 49};
        options.samples = 4;
        options.end_frame = 3;
        const auto done = renderVideo(scene, timelineOf(scene), options, file("b.mp4"));
        ASSERT_TRUE(done.ok()) << done.error().text();
        EXPECT_EQ(done.value().size, (PictureSize{66, 48}));
        EXPECT_EQ(done.value().moments, 3);
    }
}

TEST_F(Video, AProgramThatFailsLeavesNothing) {
    {
        auto writer = VideoWriter::create(file("a.mp4"), {640, 480}, 10.0, "false");
        ASSERT_TRUE(writer.ok());
        std::string message;
        for (int i = 0; i < 50 && message.empty(); ++i) { // more than the socket holds
            const auto written = writer.value().write(makePicture({640, 480}));
            message = written.ok() ? "" : written.error().text();
        }
        EXPECT_NE(message.find("ffmpeg failed"), std::string::npos) << message;
    }
    EXPECT_EQ(entries(), 0);
}

TEST_F(Video, FfmpegsOwnWordsAreInTheMessage) {
    if (!hasFfmpeg()) {
        GTEST_SKIP() << "ffmpeg is not installed";
    }
    const auto none = writeFrames(file("a.gif"), {64, 48}, 0); // a palette of no frames
    if (!none.ok()) {
        EXPECT_GT(none.error().text().size(), file("a.gif").size() + std::string(": ffmpeg failed: ").size());
        EXPECT_EQ(entries(), 0);
    }
    auto writer = VideoWriter::create(file("b.mp4"), {64, 48}, -1.0); // no such rate
    ASSERT_TRUE(writer.ok());
    const auto finished = writer.value().finish();
    ASSERT_FALSE(finished.ok());
    EXPECT_NE(finished.error().text().find("ffmpeg failed: "), std::string::npos) << finished.error().text();
}

TEST_F(Video, AMissingProgramIsNamedWithItsPackage) {
    const auto writer = VideoWriter::create(file("a.mp4"), {64, 48}, 10.0, "no-such-program-as-this");
    ASSERT_FALSE(writer.ok());
    EXPECT_NE(writer.error().text().find("apt install ffmpeg"), std::string::npos) << writer.error().text();
    EXPECT_EQ(entries(), 0);
}

TEST_F(Video, AnUnfinishedOneLeavesNothing) {
    if (!hasFfmpeg()) {
        GTEST_SKIP() << "ffmpeg is not installed";
    }
    {
        auto writer = VideoWriter::create(file("a.mp4"), {64, 48}, 10.0);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(writer.value().write(makePicture({64, 48})).ok());
        EXPECT_FALSE(writer.value().write(makePicture({32, 48})).ok());
    }
    EXPECT_EQ(entries(), 0);
    EXPECT_FALSE(VideoWriter::create(file("a.avi"), {64, 48}, 10.0).ok());
}

/// In a process of its own: what is interrupted there stays so.
[[noreturn]] void renderInterrupted(const std::string& path) {
    catchInterrupts();
    std::raise(SIGINT);
    const Scene scene = smallScene();
    VideoOptions options;
    options.size = {64, 48};
    const bool video_stopped = !renderVideo(scene, timelineOf(scene), options, path).ok();
    StrobeOptions strobe;
    strobe.size = {64, 48};
    const bool strobe_stopped = !renderStrobe(scene, timelineOf(scene), strobe, path + ".png").ok();
    std::exit(video_stopped && strobe_stopped ? 0 : 1);
}

TEST_F(Video, InterruptedRendersLeaveNothing) {
    if (!hasFfmpeg()) {
        GTEST_SKIP() << "ffmpeg is not installed";
    }
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(renderInterrupted(file("a.mp4")), testing::ExitedWithCode(0), "");
    EXPECT_EQ(entries(), 0);
}

TEST_F(Video, StillAndStrobeArePictures) {
    const Scene scene = smallScene();
    const Timeline timeline = timelineOf(scene);
    StrobeOptions options;
    options.size = {80, 45};
    options.samples = 4;
    const auto strobe = renderStrobe(scene, timeline, options, file("s.png"));
    ASSERT_TRUE(strobe.ok()) << strobe.error().text();
    EXPECT_EQ(strobe.value().moments, 6);
    options.times = {0.0, 0.33};
    EXPECT_EQ(valueOf(renderStrobe(scene, timeline, options, file("t.png"))).moments, 2);
    EXPECT_TRUE(renderStill(scene, timeline, 0.2, options, file("u.png")).ok());
    EXPECT_EQ(entries(), 3);
    EXPECT_EQ(frameCount(6.0, 30.0), 180);
    EXPECT_EQ(frameCount(0.1, 30.0), 3);
    EXPECT_EQ(frameCount(0.0, 30.0), 1);
}

} // namespace
} // namespace elastoon
