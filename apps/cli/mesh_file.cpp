// See mesh_file.h.
#include "mesh_file.h"

#include "mesh_assimp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <unordered_map>
#include <utility>

namespace elastoon {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kLeastAdded = 1e-3;
constexpr char kMeshFollows = 'm';
constexpr char kErrorFollows = 'e';

struct HashOfPoint {
    std::size_t operator()(const Vec3& p) const {
        // Adding zero makes -0 and 0 one.
        std::size_t hash = 0;
        for (const double x : {p.x + 0.0, p.y + 0.0, p.z + 0.0}) {
            hash = hash * 0x9e3779b97f4a7c15ULL + std::hash<double>{}(x);
        }
        return hash;
    }
};

class Welder {
public:
    explicit Welder(std::span<const Vec3> points) : points_(points), place_(points.size(), kNone) {}

    [[nodiscard]] std::uint32_t placeOf(std::uint32_t point) {
        if (place_[point] == kNone) {
            const auto next = static_cast<std::uint32_t>(mesh.points.size());
            const auto [at, is_new] = first_.try_emplace(points_[point], next);
            if (is_new) {
                mesh.points.push_back(points_[point]);
            }
            place_[point] = at->second;
        }
        return place_[point];
    }

    TriangleMesh mesh;

private:
    std::span<const Vec3> points_;
    std::vector<std::uint32_t> place_;
    std::unordered_map<Vec3, std::uint32_t, HashOfPoint> first_;
};

bool isFinite(const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

template <class T>
void append(std::string& bytes, const std::vector<T>& items) {
    const std::uint64_t count = items.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

template <class T>
bool take(std::span<const char>& bytes, std::vector<T>& items) {
    std::uint64_t count = 0;
    if (bytes.size() < sizeof count) {
        return false;
    }
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes = bytes.subspan(sizeof count);
    if (count > bytes.size() / sizeof(T)) {
        return false;
    }
    items.resize(count);
    if (count > 0) {
        std::memcpy(items.data(), bytes.data(), count * sizeof(T));
    }
    bytes = bytes.subspan(count * sizeof(T));
    return true;
}

std::string answerOf(const std::string& path) {
    const auto mesh = readWithAssimp(path);
    return mesh ? kMeshFollows + packed(mesh.value()) : kErrorFollows + mesh.error().message;
}

Result<TriangleMesh> readApart(const std::string& path, std::uintmax_t size, IsolationLimits limits) {
    // Ten times what large files need.
    limits.seconds += static_cast<int>(std::min<std::uintmax_t>(size >> 20, 3600));
    limits.memory += static_cast<std::size_t>(std::min<std::uintmax_t>(size, std::uintmax_t{1} << 40)) * 64;
    const auto answer = runIsolated([&] { return answerOf(path); }, limits);
    if (!answer) {
        return Error{
            fmt::format("the reading of the mesh file {}; the file is probably damaged", answer.error().message), ""};
    }
    const std::string& bytes = answer.value();
    if (bytes.starts_with(kErrorFollows)) {
        return Error{bytes.substr(1), ""};
    }
    return unpacked(bytes.empty() ? bytes : bytes.substr(1));
}

} // namespace

Result<TriangleMesh> welded(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles) {
    Welder welder(points);
    for (const TriangleMesh::Triangle& triangle : triangles) {
        TriangleMesh::Triangle placed{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (triangle[i] >= points.size()) {
                return Error{"the mesh file is damaged: a face has a corner that is not there", ""};
            }
            if (!isFinite(points[triangle[i]])) {
                return Error{fmt::format("the mesh file has a point whose coordinates are not finite: its point {}",
                                         triangle[i]),
                             ""};
            }
            placed[i] = welder.placeOf(triangle[i]);
        }
        welder.mesh.triangles.push_back(placed);
    }
    if (triangles.empty()) {
        return Error{"the mesh file holds no faces", ""};
    }
    return std::move(welder.mesh);
}

Result<TriangleMesh> readMesh(const std::string& path, const IsolationLimits& limits) {
    std::error_code failed;
    if (std::filesystem::is_directory(path, failed)) {
        return Error{"is a folder, not a mesh file", path};
    }
    if (!std::filesystem::is_regular_file(path, failed)) {
        return Error{"the mesh file cannot be read; is the path right? (It is taken from the scene's folder.)", path};
    }
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    if (failed || size == 0) {
        return Error{"the mesh file is empty", path};
    }
    auto mesh = readApart(path, size, limits);
    return mesh ? std::move(mesh) : Result<TriangleMesh>(Error{mesh.error().message, path});
}

Closedness closednessOf(const TriangleMesh& mesh) {
    struct Use {
        std::pair<std::uint32_t, std::uint32_t> edge;
        int way;
    };
    std::vector<Use> uses;
    uses.reserve(3 * mesh.triangles.size());
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = triangle[i];
            const std::uint32_t to = triangle[(i + 1) % 3];
            if (from != to) {
                uses.push_back({std::minmax(from, to), from < to ? 1 : -1});
            }
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });
    bool canceled = true;
    for (std::size_t i = 0; i < uses.size();) {
        int count = 0;
        int sum = 0;
        for (const auto edge = uses[i].edge; i < uses.size() && uses[i].edge == edge; ++i) {
            ++count;
            sum += uses[i].way;
        }
        if (count % 2 != 0) {
            return Closedness::Open;
        }
        canceled = canceled && sum == 0;
    }
    return canceled ? Closedness::Closed : Closedness::Unoriented;
}

double volumeOf(const TriangleMesh& mesh) {
    // From a point near by, so that a mesh far away keeps its digits.
    const Vec3 base = mesh.points.empty() ? Vec3(0.0) : mesh.points[0];
    double sum = 0.0;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        const auto at = [&](std::size_t i) { return mesh.points[triangle[i]] - base; };
        sum += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    return std::fabs(sum) / 6.0;
}

std::string hullNote(const std::string& shape, const std::string& file, const TriangleMesh& mesh, double hull_volume) {
    const auto unknown = [&](const char* why) {
        return fmt::format("{}: {} {}, so that its volume is not known; its convex hull has {:.3g} m³", shape, file,
                           why, hull_volume);
    };
    const Closedness closedness = closednessOf(mesh);
    if (closedness == Closedness::Open) {
        return unknown("is open");
    }
    if (closedness == Closedness::Unoriented) {
        return unknown("has faces that look inwards beside others that look outwards");
    }
    const double volume = volumeOf(mesh);
    if (!(volume <= hull_volume * (1.0 + kLeastAdded))) {
        return unknown("has parts that overlap");
    }
    if (!(hull_volume - volume >= kLeastAdded * volume)) {
        return {};
    }
    const double added = hull_volume / volume - 1.0;
    const std::string percent =
        added < 10.0 ? fmt::format("{:.1f}", 100.0 * added) : fmt::format("{:.3g}", 100.0 * added);
    return fmt::format("{}: convex hull of {} adds {} % of volume ({:.3g} -> {:.3g} m³)", shape, file, percent, volume,
                       hull_volume);
}

std::string packed(const TriangleMesh& mesh) {
    std::string bytes;
    append(bytes, mesh.points);
    append(bytes, mesh.triangles);
    return bytes;
}

Result<TriangleMesh> unpacked(const std::string& bytes) {
    TriangleMesh mesh;
    std::span<const char> left = bytes;
    if (!take(left, mesh.points) || !take(left, mesh.triangles) || !left.empty()) {
        return Error{"the mesh file is damaged", ""};
    }
    // A reader that went astray may have sent anything.
    return welded(mesh.points, mesh.triangles);
}

} // namespace elastoon
