// Mesh files of every kind give the same solid; files that are none give an error with their name, whatever assimp
// does.
#include "mesh_file.h"

#include "mesh_support.h"
#include "test_support.h"

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>

namespace elastoon {
namespace {

namespace fs = std::filesystem;

class MeshFile : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  (std::string("elastoon-") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
                   std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] Result<TriangleMesh> read(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        // assimp goes round for ever where a text .ply is cut in a line: a second of that will do.
        IsolationLimits limits;
        limits.seconds = 1;
        return readMesh(path(name), limits);
    }
    /// The error's text, which must name the file.
    [[nodiscard]] std::string errorOf(const std::string& name, const std::string& bytes) const {
        const auto mesh = read(name, bytes);
        if (mesh) {
            return "no error";
        }
        EXPECT_EQ(mesh.error().where, path(name));
        return mesh.error().message;
    }

private:
    fs::path folder_;
};

struct Written {
    const char* name;
    std::string bytes;
};

std::vector<Written> allKinds(const PolygonMesh& mesh) {
    return {{"a.obj", asObj(mesh)},        {"text.stl", asStlText(mesh)},     {"binary.stl", asStlBinary(mesh)},
            {"text.ply", asPlyText(mesh)}, {"binary.ply", asPlyBinary(mesh)}, {"a.glb", asGlb(mesh)}};
}

std::string noteOf(const TriangleMesh& mesh, const std::string& file) {
    return hullNote("rock", file, mesh, valueOf(Shape::hull(mesh.points))->volume());
}

TEST_F(MeshFile, EveryKindGivesTheSameSolid) {
    for (const Written& written : allKinds(ellPrism())) {
        const TriangleMesh mesh = valueOf(read(written.name, written.bytes));
        EXPECT_EQ(mesh.points.size(), 12U) << written.name;
        EXPECT_EQ(mesh.triangles.size(), 20U) << written.name;
        EXPECT_EQ(closednessOf(mesh), Closedness::Closed) << written.name;
        EXPECT_NEAR(volumeOf(mesh), 3.0, 1e-6) << written.name;
        EXPECT_EQ(noteOf(mesh, written.name),
                  std::string("rock: convex hull of ") + written.name + " adds 16.7 % of volume (3 -> 3.5 m³)");
    }
}

TEST_F(MeshFile, NodesPlaceTheirMeshes) {
    EXPECT_NEAR(volumeOf(valueOf(read("a.glb", asGlb(ellPrism(), 2.0)))), 24.0, 1e-5);
}

TEST_F(MeshFile, ConvexMeshesNeedNoNote) {
    PolygonMesh box = ellPrism();
    box.points[3] = box.points[4] = {2, 2, 0};
    box.points[9] = box.points[10] = {2, 2, 1};
    for (const Written& written : allKinds(box)) {
        const TriangleMesh mesh = valueOf(read(written.name, written.bytes));
        EXPECT_NEAR(volumeOf(mesh), 4.0, 1e-6) << written.name;
        EXPECT_EQ(noteOf(mesh, written.name), "") << written.name;
    }
}

TEST_F(MeshFile, VolumesThatAreNotKnownAreSaidSo) {
    PolygonMesh open = ellPrism();
    open.faces.pop_back();
    for (const Written& written : allKinds(open)) {
        const TriangleMesh mesh = valueOf(read(written.name, written.bytes));
        EXPECT_EQ(closednessOf(mesh), Closedness::Open) << written.name;
        EXPECT_EQ(noteOf(mesh, "f"), "rock: f is open, so that its volume is not known; its convex hull has 3.5 m³");
    }
    PolygonMesh flipped = ellPrism();
    std::swap(flipped.faces[3][1], flipped.faces[3][3]);
    const TriangleMesh unoriented = valueOf(read("flipped.obj", asObj(flipped)));
    EXPECT_EQ(closednessOf(unoriented), Closedness::Unoriented);
    EXPECT_NE(noteOf(unoriented, "f").find("look inwards"), std::string::npos);
    PolygonMesh twice = ellPrism();
    const auto again = twice.faces;
    twice.faces.insert(twice.faces.end(), again.begin(), again.end());
    const TriangleMesh overlapping = valueOf(read("twice.obj", asObj(twice)));
    EXPECT_EQ(closednessOf(overlapping), Closedness::Closed);
    EXPECT_NE(noteOf(overlapping, "f").find("overlap"), std::string::npos);
}

TEST_F(MeshFile, InsideOutIsTheSameVolume) {
    PolygonMesh mesh = ellPrism();
    for (auto& face : mesh.faces) {
        face = {face.rbegin(), face.rend()};
    }
    EXPECT_NEAR(volumeOf(valueOf(read("a.obj", asObj(mesh)))), 3.0, 1e-6);
}

TEST_F(MeshFile, WhatIsNoFileIsRefusedByName) {
    const auto messageFor = [&](const std::string& place) {
        const auto mesh = readMesh(place);
        EXPECT_FALSE(mesh.ok());
        EXPECT_EQ(mesh.error().where, place);
        return mesh.error().message;
    };
    EXPECT_NE(messageFor(path("gone.obj")).find("is the path right?"), std::string::npos);
    EXPECT_NE(messageFor(path("")).find("folder"), std::string::npos);
    EXPECT_NE(messageFor("/dev/zero").find("is the path right?"), std::string::npos);
}

TEST_F(MeshFile, WhatIsNoMeshIsRefusedByName) {
    Random random(3);
    std::string garbage;
    for (int i = 0; i < 1000; ++i) {
        garbage.push_back(static_cast<char>(random.below(256)));
    }
    for (const char* name : {"a.obj", "a.stl", "a.ply", "a.glb"}) {
        EXPECT_EQ(errorOf(name, ""), "the mesh file is empty");
        EXPECT_NE(errorOf(name, garbage), "no error") << name;
    }
    EXPECT_NE(errorOf("a.txt", "hello\n").find("is not a mesh file that can be read"), std::string::npos);
    EXPECT_NE(errorOf("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"), "no error");
    PolygonMesh no_faces = ellPrism();
    no_faces.faces.clear();
    for (const Written& written : allKinds(no_faces)) {
        EXPECT_NE(errorOf(written.name, written.bytes), "no error") << written.name;
    }
}

TEST_F(MeshFile, PointsThatAreNotFiniteAreRefused) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        PolygonMesh mesh = ellPrism();
        mesh.points[5].y = bad;
        for (const Written& written : allKinds(mesh)) {
            const std::string message = errorOf(written.name, written.bytes);
            EXPECT_NE(message, "no error") << written.name << " with " << bad;
            if (std::string(written.name).starts_with("binary")) {
                EXPECT_NE(message.find("not finite"), std::string::npos) << written.name << ": " << message;
            }
        }
    }
}

/// Cut short or with bytes changed, a file is a mesh or an error with the file's name.
TEST_F(MeshFile, DamagedFilesEndWell) {
    const int rounds = 8 * soak();
    Random random(4);
    int meshes = 0, errors = 0;
    for (int i = 0; i < rounds; ++i) {
        for (const Written& written : allKinds(ellPrism())) {
            std::string bytes = written.bytes;
            const auto place = [&] { return static_cast<std::size_t>(random.below(static_cast<int>(bytes.size()))); };
            if (i % 2 == 0) {
                bytes.resize(bytes.size() / 2 + place() / 2);
            }
            for (int k = random.below(4); k >= 0; --k) {
                bytes[bytes.size() / 2 + place() / 2] = static_cast<char>(random.below(256));
            }
            const auto mesh = read(written.name, bytes);
            ++(mesh ? meshes : errors);
            EXPECT_TRUE(mesh.ok() || mesh.error().where == path(written.name));
        }
    }
    EXPECT_GT(meshes, 0);
    EXPECT_GT(errors, rounds);
}

TEST(Isolated, CrashesHangsAndExceptionsAreErrors) {
    const auto messageOf = [](const std::function<std::string()>& work) {
        IsolationLimits limits;
        limits.seconds = 1;
        const auto answer = runIsolated(work, limits);
        return answer ? "answer " + answer.value() : answer.error().message;
    };
    EXPECT_EQ(messageOf([] { return std::string("is this"); }), "answer is this");
    EXPECT_EQ(messageOf([]() -> std::string { std::abort(); }), "crashed");
    EXPECT_EQ(messageOf([]() -> std::string { throw std::bad_alloc(); }), "ran out of memory");
    std::atomic<bool> never{false};
    const auto hang = [&]() -> std::string {
        while (!never) {
        }
        return "";
    };
    EXPECT_EQ(messageOf(hang), "took more than 1 s");
    std::string large(3000000, 'x');
    EXPECT_EQ(messageOf([&] { return large; }), "answer " + large);
}

TEST(MeshFilePacked, WhatWasPackedComesBackAndNothingElse) {
    const PolygonMesh ell = ellPrism();
    const TriangleMesh mesh = valueOf(welded(ell.points, ell.triangles()));
    const std::string bytes = packed(mesh);
    const TriangleMesh back = valueOf(unpacked(bytes));
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_FALSE(unpacked("").ok());
    EXPECT_FALSE(unpacked(bytes + "x").ok());
    EXPECT_FALSE(unpacked(bytes.substr(0, bytes.size() - 1)).ok());
    std::string wrong = bytes;
    wrong[wrong.size() - 1] = 'x';
    EXPECT_FALSE(unpacked(wrong).ok()) << "a corner that is none";
}

} // namespace
} // namespace elastoon
