// Volumes on disk and back, and what VTK itself sees of them.
#include <cstring>

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLMultiBlockDataReader.h>

#include "bindings/volume_file/volume_file.h"
#include "support/hall_volume.h"
#include "support/temporary_folder.h"

using namespace clv;
using namespace clv::test;

namespace {

class VolumeFile : public TemporaryFolder {
protected:
    std::string save(const BakedVolume& volume, const std::string& name = "V.vtm") const {
        writeVolume(name, volume, [this](const std::string& file) { return path(file); });
        return file(name);
    }
    std::string path(const std::string& name) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        return file(name);
    }
};

template <class T>
void expectSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
}

TEST_F(VolumeFile, comesBackToTheLastBit) {
    for (const uint storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
        BakedVolume volume = hallVolume(2, true, storage);
        volume.layout.frame = mat3(0.8f, 0.6f, 0.0f, -0.6f, 0.8f, 0.0f, 0.0f, 0.0f, 1.0f);
        const BakedVolume read = readVolume(save(volume));
        EXPECT_EQ(read.scene, volume.scene);
        EXPECT_EQ(read.libraryVersion, volume.libraryVersion);
        ASSERT_TRUE(read.mark);
        EXPECT_EQ(read.mark->triangles, volume.mark->triangles);
        EXPECT_EQ(read.mark->bounds.hi, volume.mark->bounds.hi);
        EXPECT_EQ(read.anchor, volume.anchor);
        ASSERT_EQ(read.lights.size(), 1u);
        EXPECT_EQ(read.lights[0].name, "lamp");
        EXPECT_EQ(std::memcmp(&read.lights[0].light, &volume.lights[0].light, sizeof(ClvLight)), 0);
        ASSERT_TRUE(read.camera);
        EXPECT_EQ(read.camera->name, "door");
        EXPECT_EQ(read.camera->position, volume.camera->position);
        EXPECT_EQ(read.camera->yfov, volume.camera->yfov);
        EXPECT_EQ(read.seed, volume.seed);
        EXPECT_EQ(read.frame, volume.frame);
        EXPECT_EQ(read.layout.storage, storage);
        EXPECT_EQ(read.layout.frame, volume.layout.frame);
        EXPECT_EQ(read.marginCells, volume.marginCells);
        EXPECT_EQ(read.blendCells, volume.blendCells);
        ASSERT_EQ(read.cascades.size(), volume.cascades.size());
        for (std::size_t i = 0; i < read.cascades.size(); ++i) {
            const BakedCascade &a = read.cascades[i], &b = volume.cascades[i];
            EXPECT_EQ(std::memcmp(&a.level.volume, &b.level.volume, sizeof(ClvVolume)), 0);
            ASSERT_FALSE(b.level.splits.empty());
            expectSameBytes(a.level.table, b.level.table);
            expectSameBytes(a.level.slots, b.level.slots);
            expectSameBytes(a.level.splits, b.level.splits);
            expectSameBytes(a.samples, b.samples);
            expectSameBytes(a.dynamicity, b.dynamicity);
            ASSERT_EQ(a.estimates.size(), 2u);
            for (std::size_t half = 0; half < 2; ++half) expectSameBytes(a.estimates[half], b.estimates[half]);
        }
    }
}

TEST_F(VolumeFile, readsTheSameIrradianceAsTheVolumeThatWasWritten) {
    const BakedVolume volume = hallVolume();
    const BakedVolume read = readVolume(save(volume));
    for (int i = 0; i < 200; ++i) {
        const vec3 position = vec3(clvUnitFloat(clvHash(uint(3 * i))), clvUnitFloat(clvHash(uint(3 * i + 1))), clvUnitFloat(clvHash(uint(3 * i + 2)))) * 8.0f - 4.0f;
        const ClvReceiver receiver{position, 0.0f, sideNormal(std::size_t(i) % kSides), 0.0f};
        EXPECT_EQ(irradianceAt(read, receiver), irradianceAt(volume, receiver));
    }
}

TEST_F(VolumeFile, leavesOutWhatTheVolumeDoesNotHave) {
    const BakedVolume read = readVolume(save(hallVolume(1, false)));
    EXPECT_EQ(read.cascades[0].estimates.size(), 1u);
    EXPECT_TRUE(read.cascades[0].dynamicity.empty());
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(file("V/cascade_0.vti").c_str());
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetCellData()->GetArray("variance"), nullptr);
    EXPECT_EQ(reader->GetOutput()->GetCellData()->GetArray("dynamicity"), nullptr);
}

TEST_F(VolumeFile, vtkReadsTheCellsWithTheirUnitsWhereTheyAreInTheWorld) {
    const BakedVolume volume = hallVolume();
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName(save(volume).c_str());
    reader->Update();
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
    ASSERT_TRUE(blocks);
    ASSERT_EQ(blocks->GetNumberOfBlocks(), 2u);
    for (uint k = 0; k < 2; ++k) {
        const BakedCascade& cascade = volume.cascades[k];
        auto* image = vtkImageData::SafeDownCast(blocks->GetBlock(k));
        ASSERT_TRUE(image);
        ASSERT_EQ(image->GetNumberOfCells(), vtkIdType(cascade.level.cellCount()));
        for (int axis = 0; axis < 3; ++axis) EXPECT_DOUBLE_EQ(image->GetOrigin()[axis], volume.anchor[axis] + double(cascade.level.volume.origin[axis]));
        const auto array = [&](const char* name) { return vtkFloatArray::SafeDownCast(image->GetCellData()->GetArray(name)); };
        for (const char* name : {"irradiance +x", "irradiance -z", "variance", "dynamicity", "samples", "open volume"}) ASSERT_TRUE(array(name)) << name;
        EXPECT_STREQ(array("irradiance +x")->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "W/m^2");
        EXPECT_STREQ(array("dynamicity")->GetComponentName(3), "-y");
        int empty = 0;
        for (std::size_t cell = 0; cell < cascade.level.cellCount(); ++cell) {
            const CellLight light = cellLight(volume, cascade, cell);
            empty += light.slots == 0 ? 1 : 0;
            for (int c = 0; c < 3; ++c) EXPECT_EQ(array("irradiance -z")->GetComponent(vtkIdType(cell), c), light.irradiance[5][c]);
            EXPECT_EQ(array("variance")->GetComponent(vtkIdType(cell), 2), light.variance[2]);
            EXPECT_EQ(array("dynamicity")->GetComponent(vtkIdType(cell), 2), light.dynamicity[2]);
            EXPECT_EQ(array("samples")->GetValue(vtkIdType(cell)), light.samples);
            EXPECT_EQ(array("open volume")->GetValue(vtkIdType(cell)), light.openVolume);
        }
        EXPECT_GT(empty, 0);
    }
}

TEST_F(VolumeFile, aVolumeInAFolderFindsItsPiecesThere) {
    const BakedVolume read = readVolume(save(hallVolume(), "frames/7.vtm"));
    EXPECT_EQ(read.cascades.size(), 2u);
    EXPECT_EQ(listing("frames/7"), (std::vector<std::string>{"cascade_0.vti", "cascade_1.vti"}));
}

TEST_F(VolumeFile, aSeriesKeepsTheOrderAndTheTimesOfItsFrames) {
    writeSeries("V.pvd", std::vector<SeriesStep>{{0.0, "V/0.vtm"}, {1.0 / 60.0, "V/<1>.vtm"}}, [this](const std::string& name) { return path(name); });
    const auto steps = readSeries(file("V.pvd"));
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_EQ(steps[1].vtm, "V/<1>.vtm");
    EXPECT_EQ(steps[1].time, 1.0 / 60.0);
}

}  // namespace
