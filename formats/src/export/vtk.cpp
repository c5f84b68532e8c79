// VTK's XML poly data, arrays appended raw: exact, small, and written without a library of two gigabytes.

#include <array>
#include <charconv>
#include <cstring>

#include "export/placed.h"

namespace talus::formats {
namespace {

std::string shortest(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// The file as it grows: elements in the head, their values in the appended part.
class PolyData {
 public:
    PolyData(std::size_t points, std::size_t vertices, std::size_t polygons) {
        head_ =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
            std::to_string(points) + "\" NumberOfVerts=\"" + std::to_string(vertices) +
            "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polygons) +
            "\">\n";
    }

    void open(const char* element) { head_ += std::string("<") + element + ">\n"; }
    void close(const char* element) { head_ += std::string("</") + element + ">\n"; }

    template <class Number>
    void array(const char* name, const std::vector<Number>& values, int components = 1) {
        head_ += std::string("<DataArray type=\"") + typeOf(Number{}) + "\" Name=\"" + name +
                 "\" NumberOfComponents=\"" + std::to_string(components) +
                 "\" format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
        const std::uint64_t bytes = values.size() * sizeof(Number);
        data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
        data_.append(reinterpret_cast<const char*>(values.data()), bytes);
    }

    std::string file() const {
        return head_ + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + data_ +
               "\n</AppendedData>\n</VTKFile>\n";
    }

 private:
    static const char* typeOf(double) { return "Float64"; }
    static const char* typeOf(float) { return "Float32"; }
    static const char* typeOf(std::int32_t) { return "Int32"; }
    static const char* typeOf(std::int64_t) { return "Int64"; }

    std::string head_, data_;
};

void append(std::vector<double>& flat, const Vec3& v) { flat.insert(flat.end(), {v.x(), v.y(), v.z()}); }

/// Values that each block has, spread over its faces.
struct FaceValues {
    std::vector<std::int32_t> block, motion, role;
    std::vector<float> displacement, velocity, rotation;
};

void append(std::vector<float>& flat, const VectorList<float>& list, std::size_t k) {
    flat.insert(flat.end(), {list.x[k], list.y[k], list.z[k]});
}

FaceValues faceValues(const SnapshotHeader& header, const LightFrame& frame) {
    const std::vector<FailureMode> roles = failureRoles(header, frame);
    FaceValues values;
    for (std::size_t b = 0; b < header.names.size(); ++b)
        for (auto f = header.geometry.face_begin[b]; f < header.geometry.face_begin[b + 1]; ++f) {
            if (header.geometry.isInner(static_cast<std::size_t>(f))) continue;
            values.block.push_back(static_cast<std::int32_t>(b));
            values.motion.push_back(static_cast<std::int32_t>(header.motions[b]));
            values.role.push_back(static_cast<std::int32_t>(roles[b]));
            append(values.displacement, frame.displacement, b);
            append(values.velocity, frame.velocity, b);
            append(values.rotation, frame.rotation, b);
        }
    return values;
}

/// Outlines of all faces but inner ones, one after the other, and where each ends.
struct Surface {
    std::vector<std::int32_t> vertex, end;
};

Surface surfaceOf(const RunGeometry& g) {
    Surface surface;
    for (std::size_t f = 0; f + 1 < g.face_vertex_begin.size(); ++f) {
        if (g.isInner(f)) continue;
        surface.vertex.insert(surface.vertex.end(), g.face_vertex.begin() + g.face_vertex_begin[f],
                              g.face_vertex.begin() + g.face_vertex_begin[f + 1]);
        surface.end.push_back(static_cast<std::int32_t>(surface.vertex.size()));
    }
    return surface;
}

/// Point data of the contact points, in the model frame.
struct PointValues {
    std::vector<double> place, force, shear;
    std::vector<std::int32_t> interface, block_a, block_b, state;
};

PointValues pointValues(const FullFrame& full) {
    const FrameInterfaces& f = full.interfaces;
    const FramePoints& p = full.points;
    PointValues values;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.isIdle(i)) continue;
        const auto a = static_cast<std::size_t>(f.block_a[i]);
        const Mat3 turn = turnOf(full.blocks.orientation, a);
        const Vec3 origin = at(full.blocks.position, a) + turn * at(f.origin_a, i);
        const Vec3 e1 = turn * at(f.e1_a, i), e2 = turn * at(f.e2_a, i), e3 = e1.cross(e2);
        for (auto k = static_cast<std::size_t>(f.point_begin[i]);
             k < static_cast<std::size_t>(f.point_begin[i + 1]); ++k) {
            const Vec3 shear = p.shear_1[k] * e1 + p.shear_2[k] * e2;
            append(values.place, origin + p.xi[k] * e1 + p.eta[k] * e2);
            append(values.shear, shear);
            append(values.force, shear + p.normal[k] * e3);
            values.interface.push_back(static_cast<std::int32_t>(i));
            values.block_a.push_back(f.block_a[i]);
            values.block_b.push_back(f.block_b[i]);
            values.state.push_back(static_cast<std::int32_t>(p.state[k]));
        }
    }
    return values;
}

}  // namespace

std::string vtpBlocks(const SnapshotHeader& header, const LightFrame& frame) {
    const RunGeometry& g = header.geometry;
    std::vector<double> points;
    for (const Vec3& v : placedVertices(header, frame)) append(points, v);
    const FaceValues values = faceValues(header, frame);
    PolyData poly(points.size() / 3, 0, values.block.size());
    poly.open("Points");
    poly.array("Points", points, 3);
    poly.close("Points");
    poly.open("Polys");
    const Surface surface = surfaceOf(g);
    poly.array("connectivity", surface.vertex);
    poly.array("offsets", surface.end);
    poly.close("Polys");
    poly.open("CellData");
    poly.array("block_id", values.block);
    poly.array("motion", values.motion);
    poly.array("failure_role", values.role);
    poly.array("displacement", values.displacement, 3);
    poly.array("velocity", values.velocity, 3);
    poly.array("rotation", values.rotation, 3);
    poly.close("CellData");
    return poly.file();
}

std::string vtpContacts(const FullFrame& full) {
    const PointValues values = pointValues(full);
    const std::size_t n = values.interface.size();
    std::vector<std::int64_t> index(n), offsets(n);
    for (std::size_t k = 0; k < n; ++k) {
        index[k] = static_cast<std::int64_t>(k);
        offsets[k] = static_cast<std::int64_t>(k + 1);
    }
    PolyData poly(n, n, 0);
    poly.open("Points");
    poly.array("Points", values.place, 3);
    poly.close("Points");
    poly.open("Verts");
    poly.array("connectivity", index);
    poly.array("offsets", offsets);
    poly.close("Verts");
    poly.open("PointData");
    poly.array("force", values.force, 3);
    poly.array("normal_force", full.points.normal);
    poly.array("shear_force", values.shear, 3);
    poly.array("water_force", full.points.water);
    poly.array("area", full.points.area);
    poly.array("state", values.state);
    poly.array("mobilised_friction", full.points.mobilised);
    poly.array("interface", values.interface);
    poly.array("block_a", values.block_a);
    poly.array("block_b", values.block_b);
    poly.close("PointData");
    return poly.file();
}

std::string pvdSeries(const std::vector<std::pair<double, std::string>>& files) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (const auto& [time, file] : files)
        text += "<DataSet timestep=\"" + shortest(time) + "\" part=\"0\" file=\"" + file + "\"/>\n";
    return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace talus::formats
