// What can't be done is said in one sentence, with exit code 1 and no file made or left.
#include <fmt/format.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "models/knot_scan.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

class BadInput : public CliTest {
 protected:
  void expect_no_conversion(const std::string& scan, const std::string& about) const {
    expect_refused({"convert", scan, "-o", path("out.relief")}, about);
  }
  /// A scan in XYZ text, refused.
  void expect_no_surface(const std::string& points) const {
    expect_no_conversion(write("scan.xyz", points), "scan.xyz");
  }
};

std::string xyz_points(int count, const std::function<std::string(int)>& point) {
  std::string text;
  for (int i = 0; i < count; ++i) text += point(i) + "\n";
  return text;
}

const std::string kPlyHeaderEnd =
    "property float x\nproperty float y\nproperty float z\nend_header\n";

TEST_F(BadInput, MissingFile) {
  expect_no_conversion(path("missing.ply"), "missing.ply");
  expect_refused({"info", path("missing.relief")}, "missing.relief");
  expect_refused({"render", path("missing.relief"), "-o", path("out.png")}, "missing.relief");
  expect_refused({"render", path("missing.ply"), "-o", path("out.png")}, "missing.ply");
  expect_refused({"render", path("missing.ply"), "-o", path("out.png"), "--engine", "ewa"},
                 "missing.ply");
}

TEST_F(BadInput, DirectoryAsInput) {
  std::filesystem::create_directory(path("folder.ply"));
  expect_no_conversion(path("folder.ply"), "folder.ply");
}

TEST_F(BadInput, EmptyFile) {
  for (const std::string name : {"empty.ply", "empty.pcd", "empty.obj", "empty.off", "empty.stl",
                                 "empty.xyz", "empty.ply.gz"}) {
    expect_no_conversion(write(name, ""), name);
  }
  expect_refused({"info", write("empty.relief", "")}, "empty.relief");
}

TEST_F(BadInput, TruncatedScan) {
  const std::string ply = knot_scan_ply(500);
  for (const std::size_t left : {std::size_t{2}, std::size_t{60}, ply.size() / 2, ply.size() - 1}) {
    expect_no_conversion(write("cut.ply", ply.substr(0, left)), "cut.ply");
  }
}

TEST_F(BadInput, WrongFormat) {
  expect_no_conversion(write("picture.ply", "\x89PNG\r\n\x1a\n nothing of a scan"), "picture.ply");
  expect_no_conversion(write("words.xyz", "once upon a time\nthere was a scan\n"), "words.xyz");
  expect_no_conversion(write("unknown.dat", std::string(100, '\0')), "unknown.dat");
  expect_refused({"info", write_knot(500)}, "knot.ply");
  expect_refused({"render", write("fake.relief", knot_scan_ply(500)), "-o", path("out.png")},
                 "fake.relief");
}

TEST_F(BadInput, CountsLargerThanTheFile) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string count : {"4000000000", "18446744073709551615", "1000", "-1"}) {
      const std::string header =
          fmt::format("ply\nformat {} 1.0\nelement vertex {}\n{}", format, count, kPlyHeaderEnd);
      expect_no_conversion(write("hostile.ply", header + "0 0 0\n"), "hostile.ply");
    }
  }
  expect_no_conversion(
      write("hostile.pcd",
            "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\n"
            "HEIGHT 4000000000\nPOINTS 16000000000000000000\nDATA binary\n0123456789ab"),
      "hostile.pcd");
  expect_no_conversion(write("hostile.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"),
                       "hostile.off");
  expect_no_conversion(write("hostile.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + "abc"),
                       "hostile.stl");
}

TEST_F(BadInput, SplitViewWhereThereIsNone) {
  const std::string scan = write_knot(500);
  for (const char* engine : {"multipass", "ewa"}) {
    expect_refused(
        {"render", scan, "-o", path("out.png"), "--engine", engine, "--material", "split"}, engine);
  }
  expect_refused({"bench", scan, "--material", "split"}, "split");
}

TEST_F(BadInput, TwoInterfacesWhereThereAreNone) {
  const std::string scan = write_knot(500);
  const std::vector<std::string> glass{"--material", "glass", "--interfaces", "2"};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), glass.begin(), glass.end());
    return arguments;
  };
  for (const char* engine : {"multipass", "ewa"})
    expect_refused(with({"render", scan, "-o", path("out.png"), "--engine", engine}),
                   "two interfaces");
  expect_refused(with({"render", scan, "-o", path("out.png"), "--primitive", "quad"}),
                 "two interfaces");
  expect_refused(with({"bench", scan}), "two interfaces");
}

TEST_F(BadInput, TooFewPoints) {
  const auto on_parabola = [](int i) {
    return std::to_string(i) + " " + std::to_string(i * i) + " " + std::to_string(i % 3);
  };
  expect_no_conversion(
      write("none.ply", "ply\nformat ascii 1.0\nelement vertex 0\n" + kPlyHeaderEnd), "none.ply");
  expect_no_surface(xyz_points(1, on_parabola));
  expect_no_surface(xyz_points(2, on_parabola));
  expect_no_surface("nan nan nan\nnan nan nan\n");
}

TEST_F(BadInput, TenPointsOrOneSentence) {
  // Ten points of a plane may be enough for a patch; whichever it is, it is told.
  const std::string scan =
      write("scan.xyz", xyz_points(10, [](int i) {
              return std::to_string(i % 4) + " " + std::to_string(i / 4) + " 0";
            }));
  const Outcome run = run_relief({"convert", scan, "-o", path("out.relief")});
  if (run.exit_code == 0) {
    EXPECT_EQ(run_relief({"info", path("out.relief"), "--verify"}).exit_code, 0);
  } else {
    expect_no_conversion(scan, "scan.xyz");
  }
}

TEST_F(BadInput, AllPointsEqual) {
  expect_no_surface(xyz_points(100, [](int) { return std::string("1 2 3"); }));
}

TEST_F(BadInput, AllPointsOnALine) {
  expect_no_surface(xyz_points(100, [](int i) {
    const std::string n = std::to_string(i);
    return n + " " + n + " " + n;
  }));
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  const std::string scan = write_knot(500);
  std::filesystem::create_directory(path("folder.png"));
  std::filesystem::create_directory(path("folder.relief"));
  const std::string named_so = write("scan.relief", knot_scan_ply(500));
  expect_refused({"convert", scan, "-o", path("folder.relief")}, "folder.relief");
  expect_refused({"convert", scan, "-o", path("missing/out.relief")}, "missing");
  expect_refused({"convert", named_so, "-o", named_so}, "scan.relief");
  expect_refused({"export", scan, "-o", scan}, "knot.ply");
  std::filesystem::create_symlink("/dev/null", path("null.relief"));
  expect_refused({"convert", scan, "-o", path("null.relief")}, "null.relief");
  expect_refused({"render", scan, "-o", path("folder.png")}, "folder.png");
  expect_refused({"render", scan, "-o", path("missing/out.exr")}, "missing");
}

TEST_F(BadInput, AnOlderFileStaysWhenAConversionFails) {
  const std::string scan = write("bad.xyz", "1 2 3\n");
  write("out.relief", "what was there before");
  expect_no_conversion(scan, "bad.xyz");
  EXPECT_EQ(file_bytes(path("out.relief")), "what was there before");
}

TEST_F(BadInput, FileSizeLimit) {
  const std::string scan = write_knot(5000);
  RunOptions options;
  options.largest_file = 4096;
  expect_refused({"convert", scan, "-o", path("out.relief")}, "out.relief", options);
}

TEST_F(BadInput, FullDisk) {
  const std::string scan = write_knot(5000);
  const std::string disk = path("disk");
  std::filesystem::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=8k") != 0) {
    GTEST_SKIP() << "not allowed to mount a small disk";
  }
  expect_refused({"convert", scan, "-o", disk + "/out.relief"}, "out.relief");
  EXPECT_TRUE(std::filesystem::is_empty(disk)) << "a partial file was left";
  expect_refused({"render", scan, "-o", disk + "/out.exr", "--size", "64x64"}, "out.exr");
  EXPECT_TRUE(std::filesystem::is_empty(disk)) << "a partial file was left";
  EXPECT_EQ(umount(disk.c_str()), 0);
}

TEST_F(BadInput, InterruptedConversion) {
  const std::string scan = write_knot(200000);
  const auto before = files();
  RunOptions options;
  options.terminal = true;
  options.interrupt_at = "normals";
  const Outcome run = run_relief({"convert", scan, "-o", path("out.relief")}, options);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("\r\x1b[Krelief: interrupted; nothing was written\r\n"), std::string::npos)
      << run.err;
  EXPECT_EQ(files(), before);
}

TEST_F(BadInput, InterruptedConversionInTiles) {
  const std::string scan = write_knot(500000);
  RunOptions options;
  options.terminal = true;
  options.interrupt_at = "resample";
  const Outcome run =
      run_relief({"convert", scan, "-o", path("out.relief"), "--memory", "256M"}, options);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("relief: interrupted; finished tiles are kept in " + path("out.relief") +
                         ".parts; run the same command again to resume"),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("out.relief")));
  EXPECT_TRUE(std::filesystem::exists(path("out.relief.parts")));
}

TEST_F(BadInput, DamagedPatchFile) {
  ASSERT_EQ(run_relief({"convert", write_knot(500), "-o", path("good.relief")}).exit_code, 0);
  const std::string good = file_bytes(path("good.relief"));
  ASSERT_GT(good.size(), 200U);
  // The library's own tests try every byte; here it counts that the command passes the word on.
  for (std::size_t at = 0; at < good.size(); at += good.size() / 40) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    expect_refused({"info", write("bad.relief", damaged), "--verify"}, "bad.relief");
    expect_refused({"info", write("bad.relief", good.substr(0, at)), "--verify"}, "bad.relief");
  }
  expect_refused({"info", write("bad.relief", good + "x"), "--verify"}, "bad.relief");
  expect_refused(
      {"render", write("bad.relief", good.substr(0, good.size() - 1)), "-o", path("out.png")},
      "bad.relief");
}

TEST_F(BadInput, NoOpenGl) {
  const std::string scan = write_knot(500);
  RunOptions options;
  options.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}};
  expect_refused({"render", scan, "-o", path("out.png"), "--gl", "egl"}, "OpenGL", options);
}

TEST_F(BadInput, EnvironmentThatIsNoImage) {
  const std::string scan = write_knot(500);
  expect_refused({"render", scan, "-o", path("out.png"), "--env", path("missing.hdr")},
                 "missing.hdr");
  expect_refused({"render", scan, "-o", path("out.png"), "--env", write("bad.hdr", "no picture")},
                 "bad.hdr");
}

TEST_F(BadInput, EnvironmentOfSixFilesThatAreNot) {
  const std::string scan = write_knot(500);
  const std::vector<std::string> faces{"render",        scan,    "-o",
                                       path("out.png"), "--env", path("sky_{face}.hdr")};
  expect_refused(faces, "{face} stands for px");
  for (const char* name : {"sky_right.hdr", "sky_left.hdr", "sky_top.hdr", "sky_front.hdr"})
    write(name, "no picture");
  expect_refused(faces, "sky_bottom.hdr: there is no such file");
  for (const char* name : {"sky_bottom.hdr", "sky_back.hdr"}) write(name, "no picture");
  expect_refused(faces, "sky_right.hdr: ");
}

TEST_F(BadInput, TooFewPointsToSplat) {
  for (const char* text : {"0 0 0\n", "0 0 0\n1 0 0\n0 1 0\n"}) {
    expect_refused({"render", write("few.xyz", text), "-o", path("out.png"), "--engine", "ewa"},
                   "few.xyz");
  }
}

}  // namespace
}  // namespace relief::test
