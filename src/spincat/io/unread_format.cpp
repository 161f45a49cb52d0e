#include "spincat/io/unread_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "spincat/files/paths.h"

namespace spincat {
namespace {

constexpr std::string_view kPdal = "convert it with PDAL: pdal translate a.laz a.las";
constexpr std::string_view kCloudCompare = "CloudCompare saves it as PLY";
constexpr std::string_view kGmsh = "convert it with gmsh: gmsh a.step -2 -o a.stl";
constexpr std::string_view kFreeCad = "FreeCAD exports it as STL";
constexpr std::string_view kItsProgram = "the program that made it exports it as STL";
constexpr std::string_view kBlender = "Blender exports it as glTF";
constexpr std::string_view kAssimp = "convert it with assimp: assimp export FILE a.glb";
constexpr std::string_view kMeshLab = "MeshLab saves it as PLY";
constexpr std::string_view kParaView = "ParaView saves it as PLY";
constexpr std::string_view kScanner = "the scanner's own program exports it as PLY or PTS";
constexpr std::string_view kSlicer = "PrusaSlicer exports it as STL";
constexpr std::string_view kRecorder =
    "convert it with rs-convert: rs-convert -i a.bag -p depth (PNG) or -l cloud (PLY)";
constexpr std::string_view kRos = "save its depth images as 16-bit PNG files, or its clouds as PCD files, with ROS";
constexpr std::string_view kDraco = "convert it with draco_decoder: draco_decoder -i a.drc -o a.ply";
constexpr std::string_view kNumPy = "save its points with NumPy: numpy.save('a.npy', points)";
constexpr std::string_view kUnpack = "unpack it first";

// A program is named that is known to read the format; where it is run by one line, that line.
constexpr UnreadFormat kFormats[] = {
    {".laz", "LAZ", kPdal},
    {".e57", "E57", kCloudCompare},
    {".ptx", "PTX", kCloudCompare},
    {".fls", "FARO", kScanner},
    {".rcp", "ReCap", kScanner},
    {".rcs", "ReCap", kScanner},
    {".pcap", "PCAP", "VeloView or the sensor's own program saves its frames as PCD or CSV"},
    {".bag", "RealSense or ROS bag", kRecorder},
    {".db3", "ROS 2 bag", kRos},
    {".mcap", "MCAP", kRos},
    {".step", "STEP", kGmsh},
    {".stp", "STEP", kGmsh},
    {".iges", "IGES", kGmsh},
    {".igs", "IGES", kGmsh},
    {".brep", "BREP", kGmsh},
    {".msh", "Gmsh", "convert it with gmsh: gmsh a.msh -save -o a.stl"},
    {".fcstd", "FreeCAD", kFreeCad},
    {".ifc", "IFC", kFreeCad},
    {".dxf", "DXF", kFreeCad},
    {".dwg", "DWG", kItsProgram},
    {".3dm", "Rhino", kItsProgram},
    {".catpart", "CATIA", kItsProgram},
    {".catproduct", "CATIA", kItsProgram},
    {".f3d", "Fusion 360", kItsProgram},
    {".iam", "Inventor", kItsProgram},
    {".ipt", "Inventor", kItsProgram},
    {".jt", "JT", kItsProgram},
    {".prt", "CAD part", kItsProgram},
    {".sat", "ACIS", kItsProgram},
    {".sldasm", "SolidWorks", kItsProgram},
    {".sldprt", "SolidWorks", kItsProgram},
    {".x_b", "Parasolid", kItsProgram},
    {".x_t", "Parasolid", kItsProgram},
    {".fbx", "FBX", kBlender},
    {".blend", "Blender", kBlender},
    {".usd", "USD", kBlender},
    {".usda", "USD", kBlender},
    {".usdc", "USD", kBlender},
    {".usdz", "USD", kBlender},
    {".x3d", "X3D", kBlender},
    {".wrl", "VRML", kBlender},
    {".vrml", "VRML", kBlender},
    {".dae", "COLLADA", kAssimp},
    {".3ds", "3DS", kAssimp},
    {".lwo", "LightWave", kAssimp},
    {".md2", "MD2", kAssimp},
    {".md3", "MD3", kAssimp},
    {".ms3d", "MilkShape", kAssimp},
    {".x", "DirectX", kAssimp},
    {".ctm", "OpenCTM", kMeshLab},
    {".u3d", "U3D", kItsProgram},
    {".c4d", "Cinema 4D", kItsProgram},
    {".ma", "Maya", kItsProgram},
    {".mb", "Maya", kItsProgram},
    {".max", "3ds Max", kItsProgram},
    {".skp", "SketchUp", kItsProgram},
    {".ztl", "ZBrush", kItsProgram},
    {".amf", "AMF", kSlicer},
    {".drc", "Draco", kDraco},
    {".vtk", "VTK", kParaView},
    {".vtp", "VTK", kParaView},
    {".vtu", "VTK", kParaView},
    {".h5", "HDF5", kNumPy},
    {".hdf5", "HDF5", kNumPy},
    {".7z", "7-Zip", kUnpack},
    {".bz2", "bzip2", kUnpack},
    {".gz", "gzip", kUnpack},
    {".rar", "RAR", kUnpack},
    {".tar", "tar", kUnpack},
    {".tgz", "tar", kUnpack},
    {".xz", "xz", kUnpack},
    {".zip", "ZIP", kUnpack},
    {".zst", "Zstandard", kUnpack},
};

}  // namespace

std::optional<UnreadFormat> unread_format(std::string_view extension) {
  const auto* found = std::ranges::find(kFormats, extension, &UnreadFormat::extension);
  return found == std::end(kFormats) ? std::nullopt : std::optional(*found);
}

void UnreadFiles::look_at(const std::filesystem::path& file) {
  if (std::string extension = lower_extension(file); unread_format(extension)) {
    ++counts_[std::move(extension)];
  }
}

std::string UnreadFiles::text() const {
  std::vector<std::pair<std::string, std::size_t>> counts(counts_.begin(), counts_.end());
  std::ranges::stable_sort(counts, std::ranges::greater{}, &std::pair<std::string, std::size_t>::second);
  std::size_t all = 0;
  std::string list;
  for (const auto& [extension, count] : counts) {
    all += count;
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", extension, count);
  }
  return fmt::format("{} {} that spincat does not read: {}", all, all == 1 ? "file in a format" : "files in formats",
                     list);
}

std::span<const UnreadFormat> unread_formats() {
  return kFormats;
}

}  // namespace spincat
