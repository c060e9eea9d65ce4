// The program as users run it: exit codes, messages, hashes, files that appear whole or not at all.
#include "elastoon/style.h"

#include "mesh_support.h"
#include "test_support.h"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace elastoon {
namespace {

namespace fs = std::filesystem;

struct Ran {
    int code = -1;
    std::string output; ///< standard output and error
};

Ran run(const std::string& arguments) {
    Ran ran;
    std::FILE* pipe = popen((std::string(ELASTOON_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
    std::array<char, 4096> buffer{};
    for (std::size_t got = 0; (got = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
        ran.output.append(buffer.data(), got);
    }
    const int status = pclose(pipe);
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ran;
}

/// A folder of its own for each test, gone afterwards.
class Program : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  (std::string("elastoon-") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
                   std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
        return path(name);
    }
    [[nodiscard]] std::size_t fileCount() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
    }

private:
    fs::path folder_;
};

std::string scenePath(const std::string& name) {
    return std::string(ELASTOON_SOURCE_DIR) + "/scenes/" + name;
}

std::string hashOf(const std::string& output) {
    const std::size_t at = output.find("hash=");
    return at == std::string::npos ? "" : output.substr(at + 5, 16);
}

TEST_F(Program, HashesAreTheGoldenOnes) {
    // scene, fps, hash: the same with every compiler, build type and thread count.
    std::ifstream golden(std::string(ELASTOON_SOURCE_DIR) + "/tests/golden/hashes.txt");
    ASSERT_TRUE(golden.is_open());
    std::string line;
    int lines = 0;
    while (std::getline(golden, line)) {
        if (line.empty() || line[0] == '#') {
            continue;
        }
        std::istringstream words(line);
        std::string scene, fps, hash;
        words >> scene >> fps >> hash;
        for (const char* threads : {"1", "2", "5"}) {
            const Ran ran = run("simulate " + scenePath(scene) + " --fps " + fps + " --threads " + threads);
            EXPECT_EQ(ran.code, 0) << ran.output;
            EXPECT_EQ(hashOf(ran.output), hash) << scene << " at " << fps << " fps on " << threads << " threads";
        }
        ++lines;
    }
    EXPECT_GE(lines, 6);
}

TEST_F(Program, SimulateWritesItsFilesAndTellsWhatItDid) {
    const Ran ran = run("simulate " + scenePath("hello.json") + " --fps 24 --duration 2 -o " + path("a.csv") + " -o " +
                        path("a.json") + " -o " + path("a.glb") + " --events " + path("e.csv"));
    EXPECT_EQ(ran.code, 0) << ran.output;
    EXPECT_NE(ran.output.find("bodies=5 impacts="), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("steps/s="), std::string::npos);
    EXPECT_EQ(hashOf(ran.output).size(), 16U);
    EXPECT_EQ(fileCount(), 4U);
    std::ifstream poses(path("a.csv"));
    std::string header;
    std::getline(poses, header);
    EXPECT_EQ(header, "time,body,phase,px,py,pz,qx,qy,qz,qw,stretch,vx,vy,vz");
    std::ifstream events(path("e.csv"));
    std::getline(events, header);
    EXPECT_EQ(header, "time,type,body,other,px,py,pz,nx,ny,nz,speed,s_in,s_mid,s_out,t_in,t_out");
}

TEST_F(Program, HelpIsThereForEveryCommand) {
    for (const char* command : {"", "simulate ", "render ", "figures ", "check ", "compare "}) {
        const Ran ran = run(std::string(command) + "--help");
        EXPECT_EQ(ran.code, 0) << command;
        EXPECT_GT(ran.output.size(), 200U) << command;
    }
}

TEST_F(Program, BadUseExitsWithTwoAndOneMessage) {
    const std::string good = scenePath("hello.json");
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string flat_mesh =
        write("m.json", R"({"elastoon": 1, "shapes": {"rock": {"type": "mesh", "file": "flat.obj"}}})");
    const std::string no_mesh =
        write("n.json", R"({"elastoon": 1, "shapes": {"rock": {"type": "mesh", "file": "gone.obj"}}})");
    write("empty.obj", "");
    const std::string empty_mesh =
        write("o.json", R"({"elastoon": 1, "shapes": {"rock": {"type": "mesh", "file": "empty.obj"}}})");
    const std::string typo = write("t.json", R"({"elastoon": 1, "gravty": [0, 0, 0]})");
    const std::size_t files = fileCount();
    const std::pair<std::string, std::string> cases[] = {
        {"", "subcommand"},
        {"fly", "fly"},
        {"simulate", "scene"},
        {"simulate /no/such.json", "/no/such.json"},
        {"simulate " + typo, "/gravty"},
        {"check " + typo, "did you mean \"gravity\""},
        {"simulate " + flat_mesh, "flat.obj"},
        {"simulate " + no_mesh, "gone.obj"},
        {"simulate " + empty_mesh, "empty.obj"},
        {"simulate " + good + " -o " + path("x.txt"), ".csv, .json or .glb"},
        {"simulate " + good + " --fps 0", "--fps"},
        {"simulate " + good + " --fps nan", "--fps"},
        {"simulate " + good + " --duration -1", "--duration"},
        {"simulate " + good + " --threads 0", "--threads"},
        {"render " + good, "-o"},
        {"render " + good + " -o " + path("x.bmp"), ".bmp"},
        {"render " + good + " -o " + path("x.png"), "--strobe"},
        {"render " + good + " --strobe -o " + path("x.png") + " --size 10", "--size"},
        {"render " + good + " --strobe -o " + path("x.png") + " --samples 0", "--samples"},
        {"render " + good + " -o " + path("x.mp4") + " --frames 9:3", "--frames"},
        {"render " + good + " --sheet 3 -o " + path("x.png"), "--sheet"},
        {"render " + good + " --sheet 0x3 -o " + path("x.png"), "--sheet"},
        {"render " + good + " --sheet 900x1 -o " + path("x.png"), "--sheet"},
        {"render " + good + " --sheet 3x3 --strobe -o " + path("x.png"), "needs one of"},
        {"render " + good + " --sheet 3x3 -o " + path("x.gif"), "--sheet"},
        {"render " + good + " --strobe --ghosts 2 -o " + path("x.png"), "--ghosts"},
        {"render " + good + " --strobe --fps 24 -o " + path("x.png"), "--fps"},
        {"simulate " + good + " --style jely", "known: anvil"},
        {"figures", "-o"},
        {"compare " + good, "second"},
        {"compare " + good + " " + good, "no recording"},
        {"compare /no/such.json " + good, "/no/such.json"},
        {"compare x.glb y.glb", ".json or .csv"},
    };
    for (const auto& [arguments, says] : cases) {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 2) << arguments << "\n" << ran.output;
        EXPECT_NE(ran.output.find(says), std::string::npos) << arguments << "\n" << ran.output;
    }
    EXPECT_EQ(fileCount(), files) << "nothing was written";
}

TEST_F(Program, CompareTellsWhereRunsPart) {
    const auto simulate = [&](const std::string& options, const std::string& name) {
        return "simulate " + scenePath("hello.json") + options + " -o " + path(name + ".json") + " -o " +
               path(name + ".csv") + " --events " + path(name + "-events.csv");
    };
    EXPECT_EQ(run(simulate(" --duration 2", "a")).code, 0);
    EXPECT_EQ(run(simulate(" --duration 2 --threads 3", "b")).code, 0);
    EXPECT_EQ(run(simulate(" --duration 2 --style jelly", "c")).code, 0);
    EXPECT_EQ(run(simulate(" --duration 1", "d")).code, 0);
    const auto compare = [&](const std::string& first, const std::string& second) {
        return run("compare " + path(first) + " " + path(second));
    };
    for (const char* kind : {".json", ".csv", "-events.csv"}) {
        const Ran equal = compare(std::string("a") + kind, std::string("b") + kind);
        EXPECT_EQ(equal.code, 0) << equal.output;
        EXPECT_EQ(equal.output.substr(0, 7), "equal: ");
        const Ran differs = compare(std::string("a") + kind, std::string("c") + kind);
        EXPECT_EQ(differs.code, 1) << differs.output;
        EXPECT_EQ(differs.output.substr(0, 18), "first difference: ");
    }
    EXPECT_EQ(compare("a.json", "d.json").code, 2);
    EXPECT_EQ(compare("a.csv", "d.csv").code, 2);
    EXPECT_EQ(compare("a.json", "a.csv").code, 2);
}

TEST_F(Program, StyleIsGivenToEveryBody) {
    const std::string scene = "simulate --duration 1 " + scenePath("hello.json");
    const std::string own = hashOf(run(scene).output), jelly = hashOf(run(scene + " --style jelly").output);
    EXPECT_EQ(jelly.size(), 16U);
    EXPECT_NE(jelly, own);
    EXPECT_NE(jelly, hashOf(run(scene + " --style anvil").output));
}

TEST_F(Program, SheetTakesEveryNthFrameThatFits) {
    const std::string sheet =
        "render " + scenePath("hello.json") + " --samples 1 --size 160x90 --sheet 3x2 --fps 24 -o ";
    const std::pair<const char*, const char*> cases[] = {
        {"0:6", "6 frames"}, {"0:7", "4 frames"}, {"10:12", "2 frames"}, {"0:48", "6 frames"}};
    for (const auto& [frames, says] : cases) {
        const Ran ran = run(sheet + path("s.png") + " --ghosts 1 --frames " + frames);
        EXPECT_EQ(ran.code, 0) << ran.output;
        EXPECT_NE(ran.output.find(says), std::string::npos) << ran.output;
    }
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Program, FiguresAreMade) {
    const Ran ran =
        run("figures --no-video --samples 1 --only 5 6 7 8 --scenes " + scenePath("figures") + " -o " + path(""));
    EXPECT_EQ(ran.code, 0) << ran.output;
    EXPECT_EQ(fileCount(), 5U) << ran.output;
    EXPECT_NE(ran.output.find("figure-8-squashout.png"), std::string::npos);
}

TEST_F(Program, UnwritableOutputExitsWithOne) {
    const std::string good = scenePath("hello.json");
    for (const std::string target : {"/proc/x.csv", "/dev/null/x.csv"}) {
        std::string arguments = "simulate " + good;
        arguments += " --duration 0.1 -o ";
        const Ran ran = run(arguments + target);
        EXPECT_EQ(ran.code, 1) << ran.output;
        EXPECT_NE(ran.output.find("cannot"), std::string::npos) << ran.output;
    }
    const Ran ran = run("simulate " + good + " --duration 0.1 -o " + path("") + "folder.csv/ ");
    EXPECT_NE(ran.code, 0);
}

TEST_F(Program, InterruptedWorkLeavesNothingBehind) {
    const std::string scene = scenePath("hello.json");
    const std::string film = path("film.mp4");
    const pid_t child = fork();
    if (child == 0) {
        (void)std::freopen("/dev/null", "w", stderr);
        execl(ELASTOON_PROGRAM, ELASTOON_PROGRAM, "render", scene.c_str(), "-o", film.c_str(), "--size", "640x360",
              "--samples", "64", nullptr);
        _exit(99);
    }
    // The temporary file shows that the work has begun.
    for (int i = 0; i < 3000 && fileCount() == 0; ++i) {
        usleep(10000);
    }
    EXPECT_EQ(fileCount(), 1U);
    EXPECT_FALSE(fs::exists(film));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(Program, CheckPassesTheScenes) {
    for (const char* scene : {"hello.json", "figures/1-bouncing-ball.json", "figures/2-stiff-cylinder.json",
                              "figures/3-soft-cylinder.json", "stairs.json"}) {
        const Ran ran = run("check --fps 30 --duration 2.5 " + scenePath(scene));
        EXPECT_EQ(ran.code, 0) << ran.output;
    }
}

TEST_F(Program, CheckPassesEveryStyle) {
    for (const std::string_view style : styleNames()) {
        const Ran ran =
            run("check --duration 3.5 --style " + std::string(style) + " " + scenePath("styles-stage.json"));
        EXPECT_EQ(ran.code, 0) << style << "\n" << ran.output;
    }
}

TEST_F(Program, MeshFilesBecomeTheirHulls) {
    write("rock.obj",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.2 0.2 0.2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 5\n");
    const std::string scene = write("s.json", R"({"elastoon": 1, "duration": 3,
        "shapes": {"rock": {"type": "mesh", "file": "rock.obj"}}, "bodies": [{"shape": "rock", "position": [0, 3, 0]}],
        "obstacles": [{"type": "plane", "normal": [0, 1, 0]}]})");
    const Ran ran = run("check " + scene);
    EXPECT_EQ(ran.code, 0) << ran.output;
}

TEST_F(Program, MeshNotesGoToStandardErrorAlone) {
    write("ell.obj", asObj(ellPrism()));
    const std::string scene = write("s.json", R"({"elastoon": 1, "duration": 0.1,
        "shapes": {"ball": {"type": "sphere", "radius": 1}, "rock": {"type": "mesh", "file": "ell.obj"}},
        "bodies": [{"shape": "rock", "position": [0, 3, 0]}]})");
    const std::string note = "rock: convex hull of ell.obj adds 16.7 % of volume (3 -> 3.5 m³)";
    for (const char* command : {"simulate ", "check "}) {
        const Ran both = run(command + scene);
        EXPECT_EQ(both.code, 0) << both.output;
        EXPECT_NE(both.output.find(note), std::string::npos) << both.output;
        std::string apart = command + scene;
        apart += " 2> " + path("errors") + "; true";
        EXPECT_EQ(run(apart).output.find("rock"), std::string::npos);
        std::string line;
        std::ifstream errors(path("errors"));
        std::getline(errors, line);
        EXPECT_EQ(line, note);
    }
}

/// The last word of the line that begins with this one.
std::string lastWordAfter(const std::string& text, const std::string& first) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(first)) {
            return line.substr(line.rfind(' ') + 1);
        }
    }
    return {};
}

TEST_F(Program, BenchMeasuresItsWorlds) {
    const std::string table = path("speeds.csv");
    const Ran one = run("bench pachinko --bodies 40 --seconds 0.01 --commit here --csv " + table);
    EXPECT_EQ(one.code, 0) << one.output;
    const std::string hash = lastWordAfter(one.output, "pachinko");
    EXPECT_EQ(hash.size(), 16U) << one.output;
    EXPECT_EQ(lastWordAfter(run("bench pachinko --bodies 40 --seconds 0.01 --threads 2").output, "pachinko"), hash);
    std::ifstream file(table);
    std::string heads, row;
    std::getline(file, heads);
    std::getline(file, row);
    EXPECT_EQ(heads,
              "scene,bodies,threads,steps_per_s,ns_per_body_step,bytes_per_body,hash,processor,compiler,flags,commit");
    EXPECT_TRUE(row.starts_with("pachinko,40,1,") && row.ends_with(",\"here\"")) << row;
    EXPECT_NE(row.find("," + hash + ","), std::string::npos) << row;
}

TEST_F(Program, BenchRefusesWhatItDoesNotKnow) {
    const Ran snow = run("bench snow");
    EXPECT_EQ(snow.code, 2);
    EXPECT_NE(snow.output.find("pachinko"), std::string::npos) << snow.output;
    EXPECT_EQ(run("bench rain --bodies 10 --validate-hash").code, 2);
    EXPECT_EQ(run("bench rain --threads 0").code, 2);
    EXPECT_NE(run("bench flight --bodies 5 --csv " + write("file", "") + "/there.csv").code, 0);
}

} // namespace
} // namespace elastoon
