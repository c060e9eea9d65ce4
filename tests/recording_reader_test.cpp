// What elastoon wrote is read back to the bit; what is damaged is refused with its place.
#include "recording_reader.h"

#include "export_support.h"
#include "recording.h"

namespace elastoon {
namespace {

constexpr double kFps = 24.0;
constexpr double kDuration = 2.5;

class RecordingReader : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) {
        std::ofstream(folder_.file(name)) << text;
        return folder_.file(name);
    }
    std::string writePoses() {
        const std::string file = folder_.file("poses.csv");
        EXPECT_TRUE(writePoseCsv(run_.scene, staged(), timeline(), kFps, kDuration, file).ok());
        return file;
    }
    std::string writeRecording() {
        const std::string file = folder_.file("run.json");
        EXPECT_TRUE(writeRecordingJson(run_.scene, staged(), timeline(), kFps, kDuration, file).ok());
        return file;
    }
    std::string writeEvents() {
        const std::string file = folder_.file("events.csv");
        EXPECT_TRUE(writeEventCsv(run_.scene, staged(), timeline(), file).ok());
        return file;
    }
    const StagedScene& staged() const { return run_.performance.staged; }
    const Timeline& timeline() const { return run_.performance.timeline; }

    /// The text with the first `from` replaced.
    static std::string changed(std::string text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    }
    void expectRefused(const std::string& name, const std::string& text, const std::string& says) {
        const auto run = readRun(write(name, text));
        ASSERT_FALSE(run.ok()) << says;
        EXPECT_NE(run.error().text().find(says), std::string::npos) << run.error().text();
        EXPECT_NE(run.error().text().find(name), std::string::npos) << run.error().text();
    }

    Played run_ = play(kExportScene, kDuration);
    TestFolder folder_{"recording_reader"};
};

TEST_F(RecordingReader, RecordingsComeBackToTheBit) {
    const RecordedRun run = valueOf(readRun(writeRecording()));
    EXPECT_EQ(run.kind, RecordedRun::Kind::Recording);
    EXPECT_EQ(run.fps, kFps);
    EXPECT_EQ(run.duration, kDuration);
    EXPECT_EQ(run.bodies, (std::vector<std::string>{"one", "two, \"b\"", "crate"}));
    EXPECT_EQ(run.shapes, (std::vector<std::string>{"ball", "ball", "box"}));
    ASSERT_EQ(run.poses.size(), 61U * 3U);
    for (std::size_t i = 0; i < run.poses.size(); ++i) {
        const Pose pose = timeline().tracks()[i % 3].poseAt(run.times[i / 3]);
        EXPECT_EQ(run.poses[i].numbers[1], pose.position.y);
        EXPECT_EQ(run.poses[i].numbers[7], pose.stretch);
    }
    ASSERT_EQ(run.events.size(), timeline().events().size());
    for (std::size_t i = 0; i < run.events.size(); ++i) {
        EXPECT_EQ(run.events[i].time, timeline().events()[i].time);
        EXPECT_EQ(run.events[i].numbers.front(), timeline().events()[i].point.x);
        EXPECT_EQ(run.events[i].numbers.back(), timeline().events()[i].t_out);
    }
}

TEST_F(RecordingReader, TablesHoldTheSame) {
    const RecordedRun recording = valueOf(readRun(writeRecording()));
    const RecordedRun poses = valueOf(readRun(writePoses()));
    const RecordedRun events = valueOf(readRun(writeEvents()));
    EXPECT_EQ(poses.kind, RecordedRun::Kind::Poses);
    EXPECT_EQ(events.kind, RecordedRun::Kind::Events);
    EXPECT_EQ(poses.bodies, recording.bodies);
    EXPECT_EQ(poses.times, recording.times);
    ASSERT_EQ(poses.poses.size(), recording.poses.size());
    for (std::size_t i = 0; i < poses.poses.size(); ++i) {
        const auto& numbers = poses.poses[i].numbers;
        ASSERT_EQ(numbers.size(), 11U);
        EXPECT_EQ(std::vector<double>(numbers.begin(), numbers.begin() + 8), recording.poses[i].numbers);
        EXPECT_FALSE(poses.poses[i].phase.empty());
    }
    ASSERT_EQ(events.events.size(), recording.events.size());
    for (std::size_t i = 0; i < events.events.size(); ++i) {
        EXPECT_EQ(events.events[i].body, recording.events[i].body);
        EXPECT_EQ(events.events[i].numbers, recording.events[i].numbers);
    }
}

TEST_F(RecordingReader, DamageIsRefusedWithItsPlace) {
    const std::string json = contentOf(writeRecording()), poses = contentOf(writePoses());
    expectRefused("a.txt", json, "ending");
    expectRefused("a.json", "", "damaged");
    expectRefused("a.json", json.substr(0, json.size() / 2), "damaged");
    expectRefused("a.json", "[]", "no recording");
    expectRefused("a.json", R"({"elastoon": 1})", "no recording");
    expectRefused("a.json", R"({"kind": "recording"})", "fps");
    expectRefused("a.json", changed(json, "\"fps\":24.0", "\"fps\":-1"), "above 0");
    expectRefused("a.json", changed(json, "\"fps\":24.0", "\"fps\":25.0"), "61 frames");
    expectRefused("a.json", changed(json, "\"fps\":24.0", "\"fps\":2e7"), "too few");
    expectRefused("a.json", changed(json, "\"fps\":24.0", "\"fps\":23.0"), "61 frames");
    expectRefused("a.json", changed(json, "\"frames\":[[", "\"frames\":[[1,"), "9 numbers");
    expectRefused("a.json", changed(json, "\"frames\":[[", "\"frames\":[[null,"), "damaged");
    expectRefused("a.json", changed(json, "\"t_out\"", "\"t_in_out\""), "t_out");
    expectRefused("a.csv", "", "neither");
    expectRefused("a.csv", "a,b\n1,2\n", "neither");
    expectRefused("a.csv", poses.substr(0, poses.size() - 5), "cut off");
    expectRefused("a.csv", poses.substr(0, poses.rfind('\n', poses.size() - 2) + 1), "cut off");
    expectRefused("a.csv", changed(poses, "0,one,flight,", "0,one,flight,x"), "a.csv:2");
    expectRefused("a.csv", changed(poses, "0,one,flight,", "0,one,"), "a.csv:2");
    expectRefused("a.csv", changed(poses, "0,one,flight,", "nan,one,flight,"), "a.csv:2");
    expectRefused("a.csv", changed(poses, "\n0.041666666666666664,one,", "\n0.041666666666666664,two,"), "a.csv:5");
    expectRefused("a.csv", changed(poses, "\n0.041666666666666664,crate,", "\n0.05,crate,"), "a.csv:7");
    EXPECT_FALSE(readRun("/no/such.json").ok());
    EXPECT_FALSE(readRun(testing::TempDir()).ok());
}

TEST_F(RecordingReader, RandomDamageIsReadOrRefused) {
    const std::pair<std::string, std::string> files[] = {{"a.json", contentOf(writeRecording())},
                                                         {"a.csv", contentOf(writePoses())},
                                                         {"a.csv", contentOf(writeEvents())}};
    Random random(5);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        const auto& [name, whole] = files[i % 3];
        std::string text = whole;
        for (int change = random.below(4); change >= 0; --change) {
            const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
            const int what = random.below(3);
            if (what == 0) {
                text[at] = static_cast<char>(random.below(256));
            } else if (what == 1) {
                text.erase(at, static_cast<std::size_t>(random.below(40)));
            } else {
                text.insert(at, text.substr(text.size() / 2, static_cast<std::size_t>(random.below(40))));
            }
        }
        refused += readRun(write(name, text)).ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 150);
    EXPECT_LT(refused, 300) << "damage within a number need not show";
}

} // namespace
} // namespace elastoon
