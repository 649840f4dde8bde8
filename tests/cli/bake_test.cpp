// clv bake from outside: files that hold the light that clv irradiance computes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <nlohmann/json.hpp>

#include "bindings/volume_file/volume_file.h"
#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using nlohmann::json;
using Arguments = std::vector<std::string>;

class Bake : public TemporaryFolder {
protected:
    CommandResult call(const Arguments& more) const {
        Arguments all = {"bake", "--scene", "cornell", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return runCommand(all);
    }
    json run(const Arguments& more) const {
        const CommandResult result = call(more);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out);
    }
    BakedVolume bake(const std::string& name, const Arguments& more) const {
        Arguments all = {"--out", file(name)};
        all.insert(all.end(), more.begin(), more.end());
        run(all);
        return readVolume(file(name));
    }

    // Receivers on the floor and the back wall of the Cornell box.
    static std::vector<ClvReceiver> receivers() {
        std::vector<ClvReceiver> all;
        for (int i = 0; i < 6; ++i) {
            for (int j = 0; j < 6; ++j) {
                const float x = 0.06f + 0.085f * float(i), y = 0.06f + 0.085f * float(j);
                all.push_back({vec3(x, 0.0f, y), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
                all.push_back({vec3(x, y, 0.5592f), 0.0f, vec3(0.0f, 0.0f, -1.0f), 0.0f});
            }
        }
        return all;
    }
    static std::vector<vec3> read(const BakedVolume& volume) {
        std::vector<vec3> values;
        for (const ClvReceiver& receiver : receivers()) values.push_back(irradianceAt(volume, receiver));
        return values;
    }
    // What clv irradiance says there, W/m^2.
    std::vector<vec3> irradiance(const Arguments& more) const {
        std::ostringstream points;
        points << "px,py,pz,nx,ny,nz\n";
        for (const ClvReceiver& r : receivers()) points << r.position.x << ',' << r.position.y << ',' << r.position.z << ',' << r.normal.x << ',' << r.normal.y << ',' << r.normal.z << '\n';
        Arguments all = {"irradiance", "--scene", "cornell", "--points", write("p.csv", points.str()), "--out", file("r.csv")};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(runCommand(all).status, 0);
        std::istringstream rows(TemporaryFolder::read(file("r.csv")));
        std::vector<vec3> values;
        std::string row;
        for (std::getline(rows, row); std::getline(rows, row);) {
            std::array<float, 9> numbers{};
            std::istringstream cells(row);
            for (float& number : numbers) {
                std::string cell;
                std::getline(cells, cell, ',');
                number = std::stof(cell);
            }
            values.push_back({numbers[6], numbers[7], numbers[8]});
        }
        return values;
    }
    static double relativeRmse(const std::vector<vec3>& values, const std::vector<vec3>& truth) {
        double squares = 0.0, sum = 0.0;
        EXPECT_EQ(values.size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i) {
            squares += double(dot(values[i] - truth[i], values[i] - truth[i]));
            sum += double(truth[i].x) + double(truth[i].y) + double(truth[i].z);
        }
        const double count = 3.0 * double(truth.size());
        return std::sqrt(squares / count) / (sum / count);
    }
    static double meanOf(const std::vector<vec3>& values) {
        double sum = 0.0;
        for (const vec3& value : values) sum += double(value.x + value.y + value.z);
        return sum / double(3 * values.size());
    }
    static double meanVariance(const BakedVolume& volume) {
        double sum = 0.0;
        const BakedCascade& cascade = volume.cascades[0];
        for (std::size_t cell = 0; cell < cascade.level.cellCount(); ++cell) sum += double(cellLight(volume, cascade, cell).variance[2]);
        return sum / double(cascade.level.cellCount());
    }
};

TEST_F(Bake, theVolumeReadsAsIrradianceDoes) {
    // Both are the same estimate, from different halves of one sequence; noise of this many rays stays below.
    for (const std::string bounces : {"one", "all"}) {
        const Arguments options = {"--resolution", "8", "--rays", "1M", "--bounces", bounces};
        const BakedVolume volume = bake("V.vtm", options);
        EXPECT_EQ(volume.allBounces, bounces == "all");
        EXPECT_LT(relativeRmse(read(volume), irradiance(options)), 0.03) << bounces;
    }
    EXPECT_EQ(listing("V"), Arguments{"cascade_0.vti"});
}

TEST_F(Bake, everyCascadeHasTheLightOfAllBounces) {
    const auto lightOf = [&](const std::string& bounces) {
        const BakedVolume volume = bake("V.vtm", {"--resolution", "8", "--rays", "1M", "--cascades", "2", "--bounces", bounces});
        EXPECT_EQ(volume.cascades.size(), 2u);
        std::vector<double> sums;
        for (const BakedCascade& cascade : volume.cascades) {
            for (const std::vector<float>& half : cascade.estimates) {
                double sum = 0.0;
                for (const float deposit : half) sum += double(deposit);
                sums.push_back(sum);
            }
        }
        return sums;
    };
    const std::vector<double> one = lightOf("one"), all = lightOf("all");
    ASSERT_EQ(one.size(), 4u) << "two halves of each";
    ASSERT_EQ(all.size(), 4u);
    // Further bounces of the Cornell box bring about as much again as the first one.
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_GT(all[k], 1.3 * one[k]) << k;
        EXPECT_NEAR(all[k] / all[k % 2 == 0 ? k + 1 : k - 1], 1.0, 0.03) << k;
    }
}

TEST_F(Bake, saysWhereTheLightComesFrom) {
    const BakedVolume volume = bake("V.vtm", {"--resolution", "8", "--rays", "16k", "--seed", "5", "--storage", "sh1"});
    EXPECT_EQ(volume.scene, "cornell");
    EXPECT_EQ(volume.libraryVersion, "0.1.0");
    EXPECT_EQ(volume.seed, 5u);
    EXPECT_EQ(volume.layout.storage, kClvStorageSh1);
    EXPECT_FALSE(volume.lights.empty());
    EXPECT_FALSE(volume.camera);
    EXPECT_GE(volume.cascades[0].samples[0], 14000.0f);
    EXPECT_TRUE(volume.cascades[0].dynamicity.empty()) << "no light moves";
}

TEST_F(Bake, isTheSameForTheSameSeedWhateverTheThreads) {
    const Arguments options = {"--resolution", "8", "--rays", "16k", "--out"};
    for (const std::string threads : {"1", "2"}) {
        Arguments all = options;
        all.insert(all.end(), {file("V" + threads + ".vtm"), "--threads", threads});
        run(all);
    }
    EXPECT_EQ(TemporaryFolder::read(file("V1/cascade_0.vti")), TemporaryFolder::read(file("V2/cascade_0.vti")));
}

TEST_F(Bake, cascadesStandAroundTheCameraAndTheLastOneHoldsTheScene) {
    const BakedVolume volume = bake("V.vtm", {"--cascades", "3", "--resolution", "12", "--rays", "64k"});
    ASSERT_EQ(volume.cascades.size(), 3u);
    ASSERT_TRUE(volume.camera);
    for (std::size_t k = 0; k < 3; ++k) {
        const ClvVolume& grid = volume.cascades[k].level.volume;
        EXPECT_EQ(grid.resolution, ivec3(12));
        EXPECT_FLOAT_EQ(grid.cellSize, volume.cascades[0].level.volume.cellSize * float(1 << k));
        EXPECT_GT(clvCellsToEdge(grid, volume.camera->position), 5.0f);
    }
    for (const ClvReceiver& receiver : receivers()) EXPECT_GE(clvCellsToEdge(volume.cascades[2].level.volume, receiver.position), volume.marginCells);
    const std::vector<vec3> values = read(volume);
    double sum = 0.0;
    for (const vec3& value : values) sum += double(value.x);
    EXPECT_GT(sum, 0.0);
}

TEST_F(Bake, finerCellsCanBeAskedFor) {
    const BakedVolume volume = bake("V.vtm", {"--cascades", "2", "--resolution", "10", "--cell-size", "0.03", "--rays", "16k"});
    EXPECT_FLOAT_EQ(volume.cascades[0].level.volume.cellSize, 0.03f);
    EXPECT_FLOAT_EQ(volume.cascades[1].level.volume.cellSize, 0.06f);
}

TEST_F(Bake, aSeriesConvergesFromFrameToFrame) {
    const json report = run({"--out", file("V.pvd"), "--frames", "4", "--resolution", "6", "--rays", "64k"});
    EXPECT_EQ(report["frames"], 4);
    EXPECT_EQ(listing(), (Arguments{"V", "V.pvd"}));
    const auto steps = readSeries(file("V.pvd"));
    ASSERT_EQ(steps.size(), 4u);
    const BakedVolume first = readVolume((folder_ / steps[0].vtm).string()), last = readVolume((folder_ / steps[3].vtm).string());
    EXPECT_EQ(last.frame, 3u);
    EXPECT_NEAR(last.cascades[0].samples[0], 4.0f * first.cascades[0].samples[0], 64.0f);
    EXPECT_LT(meanVariance(last), meanVariance(first));
    EXPECT_GT(meanVariance(last), 0.0);
}

TEST_F(Bake, aLampThatMovesMakesTheSidesThatItReachesDynamic) {
    const std::string motion = write("m.json", R"({"fps": 30, "lights": [{"name": "lamp", "keys": [{"frame": 1, "position": [0.2, 0.5, 0.2]}, {"frame": 4, "position": [0.35, 0.5, 0.35]}]}]})");
    const json report = run({"--out", file("V.pvd"), "--motion", motion, "--resolution", "8", "--rays", "32k"});
    EXPECT_EQ(report["frames"], 5) << "as many as the motion has";
    const auto steps = readSeries(file("V.pvd"));
    ASSERT_EQ(steps.size(), 5u);
    EXPECT_NEAR(steps[4].time, 4.0 / 30.0, 1e-12);
    for (std::size_t frame = 0; frame < steps.size(); ++frame) {
        const BakedVolume volume = readVolume((folder_ / steps[frame].vtm).string());
        ASSERT_FALSE(volume.cascades[0].dynamicity.empty());
        const float most = std::ranges::max(volume.cascades[0].dynamicity);
        EXPECT_EQ(most, frame < 2 ? 0.0f : 1.0f) << frame;
        EXPECT_EQ(volume.lights[0].light.dynamicity, frame < 2 ? 0.0f : 1.0f);
        EXPECT_EQ(volume.frame, frame);
    }
    const BakedVolume first = readVolume((folder_ / steps[1].vtm).string()), last = readVolume((folder_ / steps[4].vtm).string());
    EXPECT_NEAR(last.lights[0].light.position.x - first.lights[0].light.position.x, 0.15f, 1e-6f);
    // The light of a lamp elsewhere, not a mean over the way there.
    const BakedVolume there = bake("W.vtm", {"--lights", write("l.json", R"({"lights":[{"name":"lamp","type":"spot","position":[0.35,0.5,0.35],"direction":[0,-1,0],"intensity":[3,2.6,2],"outerConeAngle":1.5707963}]})"),
                                             "--resolution", "8", "--rays", "1M"});
    EXPECT_LT(relativeRmse(read(last), read(there)), 0.5 * relativeRmse(read(first), read(there)));
}

TEST_F(Bake, lightThatStandsStillConvergesInAMotionToo) {
    const std::string motion = write("m.json", R"({"lights": [{"name": "lamp", "keys": [{"frame": 0}, {"frame": 7}]}]})");
    run({"--out", file("V.pvd"), "--motion", motion, "--resolution", "8", "--rays", "128k"});
    const BakedVolume last = readVolume((folder_ / readSeries(file("V.pvd"))[7].vtm).string());
    // Another grid: its cells err elsewhere, and the mean stays.
    const std::vector<vec3> still = irradiance({"--resolution", "8", "--rays", "1M"}), values = read(last);
    EXPECT_LT(relativeRmse(values, still), 0.15);
    EXPECT_NEAR(meanOf(values), meanOf(still), 0.03 * meanOf(still));
    EXPECT_NEAR(last.cascades[0].samples[0], float(1 << 20), 64.0f);
}

TEST_F(Bake, cascadesFollowACameraThatMoves) {
    const std::string motion = write("m.json", R"({"camera": {"keys": [{"frame": 0, "position": [0.28, 0.28, -0.5], "target": [0.28, 0.28, 0.3]}, {"frame": 3, "position": [0.28, 0.28, 0.1]}]}})");
    run({"--out", file("V.pvd"), "--motion", motion, "--cascades", "2", "--resolution", "12", "--cell-size", "0.05", "--rays", "32k"});
    const auto steps = readSeries(file("V.pvd"));
    ASSERT_EQ(steps.size(), 4u);
    const BakedVolume first = readVolume((folder_ / steps[0].vtm).string()), last = readVolume((folder_ / steps[3].vtm).string());
    EXPECT_NEAR(last.cascades[0].level.volume.origin.z - first.cascades[0].level.volume.origin.z, 0.6f, 0.051f);
    ASSERT_TRUE(first.camera && last.camera);
    EXPECT_NEAR(last.camera->position.z - first.camera->position.z, 0.6f, 1e-5f);
    EXPECT_NEAR(last.camera->forward.z, 1.0f, 1e-5f);
}

TEST_F(Bake, replacesAnEarlierVolumeAndLeavesNothingElse) {
    const BakedVolume coarse = bake("V.vtm", {"--resolution", "4", "--rays", "8k"}), fine = bake("V.vtm", {"--resolution", "6", "--rays", "8k"});
    EXPECT_GT(fine.cascades[0].level.cellCount(), coarse.cascades[0].level.cellCount());
    EXPECT_EQ(listing(), (Arguments{"V", "V.vtm"}));
}

// ParaView's Python conflicts with VTK's headers in Debian, so it cannot be installed beside them: CLV_PARAVIEW names a folder into which
// the packages paraview and python3-paraview are unpacked (dpkg -x).
TEST_F(Bake, paraViewOpensVolumesAndSeries) {
    const char* paraView = std::getenv("CLV_PARAVIEW");
    if (!paraView) GTEST_SKIP() << "no ParaView: CLV_PARAVIEW names no folder of it";
    const auto seen = [&](const std::string& name) {
        const std::string root = paraView, script = CLV_SOURCE_DIR "/tests/cli/paraview_opens.py";
        const std::string command = "LD_LIBRARY_PATH='" + root + "/usr/lib/x86_64-linux-gnu' PYTHONPATH='" + root + "/usr/lib/python3/dist-packages' '" + root + "/usr/bin/pvpython' '" +
                                    script + "' '" + file(name) + "' > '" + file("seen.json") + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
        return json::parse(TemporaryFolder::read(file("seen.json")));
    };
    const BakedVolume volume = bake("V.vtm", {"--cascades", "2", "--resolution", "8", "--rays", "16k"});
    const json opened = seen("V.vtm");
    ASSERT_EQ(opened["blocks"].size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        const json& block = opened["blocks"][k];
        const BakedCascade& cascade = volume.cascades[k];
        EXPECT_EQ(block["cells"], 512);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(double(block["bounds"][std::size_t(2 * axis)]), volume.anchor[axis] + double(cascade.level.volume.origin[axis]), 1e-9);
        for (const char* array : {"irradiance +x", "irradiance -z", "variance", "samples", "open volume", "level", "entry"}) EXPECT_TRUE(block["arrays"].contains(array)) << array;
        float brightest = 0.0f;
        for (std::size_t cell = 0; cell < cascade.level.cellCount(); ++cell) brightest = std::max(brightest, cellLight(volume, cascade, cell).irradiance[2].x);
        EXPECT_EQ(float(block["arrays"]["irradiance +y"][1]), brightest);
        EXPECT_EQ(block["arrays"]["level"][0], double(k));
        EXPECT_EQ(json::parse(std::string(block["about"]))["scene"], "cornell");
    }
    run({"--out", file("S.pvd"), "--frames", "3", "--resolution", "4", "--rays", "16k"});
    const json series = seen("S.pvd");
    ASSERT_EQ(series["times"].size(), 3u);
    EXPECT_NEAR(double(series["times"][2]), 2.0 / 60.0, 1e-12);
}

TEST_F(Bake, badUsageIsOneLineAndLeavesNoFile) {
    write("lights.json", R"({"lights":[{"type":"point","position":[0.27,0.5,0.27],"intensity":[0,0,0]}]})");
    write("taken", "a file");
    const std::string motion = write("m.json", R"({"lights": [{"name": "lamp", "keys": [{"frame": 0}, {"frame": 1, "position": [0.3, 0.5, 0.3]}]}]})");
    const std::string sun = write("sun.json", R"({"lights": [{"name": "sun", "keys": [{"frame": 0}]}]})");
    const std::string away = write("away.json", R"({"camera": {"keys": [{"frame": 0, "position": [0.28, 1e11, 0.1]}]}})");
    const std::vector<std::pair<Arguments, std::string>> cases = {
        {{"--out", file("V.vti")}, ".vtm"},
        {{"--out", file("V.vtm"), "--frames", "2"}, ".pvd"},
        {{"--out", file("V.pvd"), "--frames", "2", "--bounces", "all"}, "--frames"},
        {{"--out", file("V.vtm"), "--camera", "0"}, "--camera"},
        {{"--out", file("V.vtm"), "--cascades", "2", "--camera", "nobody"}, "nobody"},
        {{"--out", file("V.vtm"), "--cascades", "2", "--resolution", "7"}, "resolution"},
        {{"--out", file("missing/V.vtm")}, "missing"},
        {{"--out", file("taken.vtm"), "--rays", "8k", "--resolution", "4"}, "taken"},
        {{"--out", file("V.vtm"), "--lights", file("lights.json")}, "no light is on"},
        {{"--out", file("V.vtm"), "--motion", motion}, ".pvd"},
        {{"--out", file("V.pvd"), "--motion", sun, "--frames", "2"}, "sun.json: lights[0].name"},
        {{"--out", file("V.pvd"), "--motion", file("none.json")}, "none.json"},
        {{"--out", file("V.vtm"), "--motion", away, "--cascades", "2", "--cell-size", "0.05"}, "away.json: frame 0: camera"},
        {{"--out", file("V.pvd"), "--motion", motion, "--bounces", "all"}, "--motion"},
        {{"--out", file("V.pvd"), "--motion", motion, "--seconds", "1"}, "--seconds"},
        {{"--out", file("V.pvd"), "--motion", motion, "--cell-shift", "0.5,0,0"}, "--cell-shift"},
        {{"--out", file("V.pvd"), "--motion", motion, "--backend", "vulkan"}, "--backend"},
        {{"--out", file("V.pvd"), "--motion", motion, "--cascades", "2", "--resolution", "7"}, "resolution"},
    };
    for (const auto& [arguments, expected] : cases) {
        const CommandResult result = call(arguments);
        EXPECT_EQ(result.status, 2) << expected;
        EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    EXPECT_EQ(listing(), (Arguments{"away.json", "lights.json", "m.json", "sun.json", "taken"}));
}

TEST_F(Bake, anInterruptLeavesNoFile) {
    RunningCommand running({"bake", "--scene", "cornell", "--out", file("V.pvd"), "--frames", "1000", "--resolution", "8", "--rays", "64M"});
    for (int wait = 0; wait < 6000 && listing().empty(); ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_FALSE(listing().empty());
    running.send(SIGINT);
    EXPECT_EQ(running.wait().status, 128 + SIGINT);
    EXPECT_EQ(listing(), Arguments{});
}

}  // namespace
