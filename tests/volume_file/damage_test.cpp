// A damaged volume gives one line, never a wrong number, a crash or a word of VTK's own.
#include <algorithm>
#include <cstring>

#include "bindings/volume_file/sealed_file.h"
#include "bindings/volume_file/volume_file.h"
#include "bindings/volume_file/volume_text.h"
#include "support/hall_volume.h"
#include "support/temporary_folder.h"

using namespace clv;
using namespace clv::test;

namespace {

class DamagedVolume : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        BakedVolume volume = hallVolume(2, true, kClvStorageCube);
        volume.cascades.pop_back();
        std::filesystem::create_directories(folder_ / "V");
        writeVolume("V.vtm", volume, [this](const std::string& name) { return file(name); });
        piece_ = read(file("V/cascade_0.vti"));
        // Without its seal.
        body_ = piece_.substr(0, piece_.rfind("\n<!-- clv"));
    }

    // What reading says; empty if it succeeds. Nothing is printed.
    std::string complaint() const {
        testing::internal::CaptureStderr();
        testing::internal::CaptureStdout();
        std::string said;
        try {
            readVolume(file("V.vtm"));
        } catch (const InputError& error) {
            said = error.what();
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
        EXPECT_EQ(said.find('\n'), std::string::npos);
        return said;
    }
    // The piece with another text in place of the first `from`, sealed again: damage that its checksum does not show.
    std::string complaintOf(const std::string& from, const std::string& to) const {
        std::string changed = body_;
        const std::size_t at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        return complaintOfBody(changed);
    }
    std::string complaintOfBody(const std::string& body) const {
        sealFile(write("V/cascade_0.vti", body));
        return complaint();
    }
    // Where the numbers of an array begin in body_.
    std::size_t dataOf(const std::string& array) const {
        const std::size_t name = body_.find("Name=\"" + array + "\""), offset = body_.find("offset=\"", name) + 8;
        return body_.find("\n   _") + 5 + std::stoul(body_.substr(offset)) + sizeof(std::uint64_t);
    }
    std::string complaintOfWord(const std::string& array, std::size_t index, std::uint32_t word) const {
        std::string changed = body_;
        std::memcpy(changed.data() + dataOf(array) + 4 * index, &word, 4);
        return complaintOfBody(changed);
    }
    static bool names(const std::string& said, const std::string& what) { return said.find("cascade_0.vti: ") != std::string::npos && said.find(what) != std::string::npos; }

    std::string piece_, body_;
};

TEST_F(DamagedVolume, isSoundBeforeItIsDamaged) {
    EXPECT_EQ(complaint(), "");
    EXPECT_EQ(complaintOfBody(body_), "");
}

TEST_F(DamagedVolume, anyFlippedByteIsSeen) {
    for (const std::string name : {"V.vtm", "V/cascade_0.vti"}) {
        const std::string sound = read(file(name));
        const std::size_t last = sound.size() - 1, places = 150;
        for (std::size_t place = 0; place <= places; ++place) {
            const std::size_t at = last * place / places;
            std::string changed = sound;
            changed[at] = char(changed[at] ^ (1 << at % 8));
            write(name, changed);
            EXPECT_NE(complaint().find("checksum"), std::string::npos) << name << ", byte " << at;
        }
        write(name, sound);
    }
}

TEST_F(DamagedVolume, anyMissingTailIsSeen) {
    for (const std::string name : {"V.vtm", "V/cascade_0.vti"}) {
        const std::string sound = read(file(name));
        for (std::size_t part = 0; part < 40; ++part) {
            write(name, sound.substr(0, sound.size() * part / 40));
            EXPECT_NE(complaint().find(name), std::string::npos) << name << ", part " << part;
        }
        write(name, sound.substr(0, sound.size() - 1));
        EXPECT_NE(complaint().find(name), std::string::npos);
        write(name, sound);
    }
}

TEST_F(DamagedVolume, aMissingFileIsNamed) {
    std::filesystem::remove(file("V/cascade_0.vti"));
    EXPECT_TRUE(names(complaint(), "no such file"));
    EXPECT_THROW(readVolume(file("other.vtm")), InputError);
    std::filesystem::create_directory(file("V/cascade_0.vti"));
    EXPECT_TRUE(names(complaint(), "expected a file, not a folder"));
}

TEST_F(DamagedVolume, filesThatLieElsewhereAreNotRead) {
    const std::string whole = read(file("V.vtm")), index = whole.substr(0, whole.rfind("\n<!-- clv")), name = "V/cascade_0.vti";
    std::filesystem::create_directories(folder_ / "W");
    const std::string absolute = file(name);
    for (const std::string& elsewhere : {absolute, std::string("W/../V/cascade_0.vti"), std::string("V/cascade_0.vti&#10;x")}) {
        std::string changed = index;
        changed.replace(changed.find(name), name.size(), elsewhere);
        sealFile(write("V.vtm", changed));
        EXPECT_EQ(complaint(), file("V.vtm") + ": expected data sets whose files lie beside it, or in folders there") << elsewhere;
    }
}

TEST_F(DamagedVolume, sealedTextOfAnyKindIsNoVolume) {
    for (const char* text : {"", "clv", "<", "<VTKFile", "<VTKFile/>", "<a></b>", "<VTKFile type=\"ImageData\"><ImageData></VTKFile>", "<VTKFile type=\"ImageData\" version=\"1.0\"/>",
                             "<VTKFile type=\"PolyData\" version=\"1.0\"/>"}) {
        EXPECT_TRUE(names(complaintOfBody(text), "expected")) << text;
    }
    std::string garbled = body_;
    for (std::size_t at = 0; at < body_.find("<AppendedData"); at += 37) {
        garbled[at] = char(garbled[at] ^ 0x15);
        complaintOfBody(garbled);
        garbled[at] = body_[at];
    }
}

TEST_F(DamagedVolume, wrongHeadersAreNamed) {
    EXPECT_TRUE(names(complaintOf("byte_order=\"LittleEndian\"", "byte_order=\"BigEndian\""), "little-endian"));
    EXPECT_TRUE(names(complaintOf("header_type=\"UInt64\"", "header_type=\"UInt32\""), "UInt64"));
    EXPECT_TRUE(names(complaintOf("encoding=\"raw\"", "encoding=\"base64\""), "raw"));
    EXPECT_TRUE(names(complaintOf("\"format\":2", "\"format\":1"), "version of volume files"));
    EXPECT_TRUE(names(complaintOf("\"channels\":3", "\"channels\":2"), "channels"));
    EXPECT_TRUE(names(complaintOf("\"storage\":\"cube\"", "\"storage\":\"cone\""), "cube9"));
    EXPECT_TRUE(names(complaintOf("\"seed\":", "\"sees\":"), "seed"));
    EXPECT_TRUE(names(complaintOf("{\"format\"", "[\"format\""), "JSON"));
    EXPECT_NE(complaintOf("\"cascades\":1", "\"cascades\":2").find("expected 2 cascades"), std::string::npos);
    EXPECT_TRUE(names(complaintOf("\"cell_size\":0.", "\"cell_size\":-."), "JSON"));
    EXPECT_TRUE(names(complaintOf("\"resolution\":[8", "\"resolution\":[0"), "resolution"));
    EXPECT_TRUE(names(complaintOf("\"resolution\":[8", "\"resolution\":[9"), "tuples"));
}

TEST_F(DamagedVolume, missingAndMisshapenArraysAreNamed) {
    for (const std::string array : {"entry", "slot centroid", "slot volume", "slot visible", "slot cell", "slot samples", "slot deposits 0", "split plane", "split links", "about", "grid"}) {
        std::string other = array;
        other[0] = 'X';
        EXPECT_TRUE(names(complaintOf("Name=\"" + array + "\"", "Name=\"" + other + "\""), array)) << array;
    }
    EXPECT_TRUE(names(complaintOf("type=\"UInt32\" Name=\"slot cell\"", "type=\"Float32\" Name=\"slot cell\""), "slot cell"));
    EXPECT_TRUE(names(complaintOf("Name=\"slot visible\" NumberOfComponents=\"4\"", "Name=\"slot visible\" NumberOfComponents=\"3\""), "slot visible"));
}

TEST_F(DamagedVolume, hugeSizesTakeNoMemory) {
    const std::size_t tuples = body_.find("NumberOfTuples=\"", body_.find("Name=\"slot volume\"")) + 16;
    for (const char* count : {"999999999999", "-1", "x", "18446744073709551615"}) {
        std::string changed = body_;
        changed.replace(tuples, changed.find('"', tuples) - tuples, count);
        EXPECT_TRUE(names(complaintOfBody(changed), "slot volume")) << count;
    }
    std::string changed = body_;
    const std::uint64_t bytes = std::uint64_t(1) << 62;
    std::memcpy(changed.data() + dataOf("slot volume") - 8, &bytes, 8);
    EXPECT_TRUE(names(complaintOfBody(changed), "slot volume"));
    const auto grid = [](std::uint64_t z) { return nlohmann::json{{"origin", {0, 0, 0}}, {"cell_size", 1}, {"resolution", {1290u, 1290u, z}}}; };
    EXPECT_EQ(gridFromDescription("g", grid(1290), kClvStorageCube).resolution, ivec3(1290));
    EXPECT_THROW(gridFromDescription("g", grid(1291), kClvStorageCube), InputError);
    EXPECT_THROW(gridFromDescription("g", grid(~std::uint64_t(0)), kClvStorageCube), InputError);
}

TEST_F(DamagedVolume, numbersThatAreNotFiniteAreNamed) {
    const std::uint32_t nan = 0x7fc00000u, infinity = 0x7f800000u;
    for (const std::string array : {"slot deposits 0", "slot deposits 1", "slot samples", "slot dynamicity"}) {
        EXPECT_TRUE(names(complaintOfWord(array, 5, nan), array)) << array;
        EXPECT_TRUE(names(complaintOfWord(array, 5, infinity), array)) << array;
    }
    EXPECT_TRUE(names(complaintOfWord("slot volume", 5, nan), "slot 5: expected an open volume"));
    EXPECT_TRUE(names(complaintOfWord("slot volume", 5, 0), "slot 5: expected an open volume"));
    EXPECT_TRUE(names(complaintOfWord("slot centroid", 16, infinity), "slot 5: expected a finite centroid"));
    EXPECT_TRUE(names(complaintOfWord("slot dynamicity", 5, 0x40000000u), "slot dynamicity"));
}

TEST_F(DamagedVolume, tablesThatLeadAstrayAreNamed) {
    const BakedVolume volume = readVolume(file("V.vtm"));
    const Level& level = volume.cascades[0].level;
    const std::size_t whole = std::size_t(std::ranges::find_if(level.table, [](uint entry) { return entry != kClvNoSlot && !clvIsSplit(entry); }) - level.table.begin());
    const std::size_t cut = std::size_t(std::ranges::find_if(level.table, [](uint entry) { return clvIsSplit(entry); }) - level.table.begin());
    ASSERT_LT(cut, level.table.size());
    const uint root = level.table[cut] & ~kClvSplitBit;
    EXPECT_TRUE(names(complaintOfWord("entry", whole, uint(level.slots.size())), "cell "));
    EXPECT_TRUE(names(complaintOfWord("entry", whole, level.table[whole] + 1), "one cell that it belongs to"));
    EXPECT_TRUE(names(complaintOfWord("entry", whole, kClvNoSlot), "a cell for each"));
    EXPECT_TRUE(names(complaintOfWord("entry", cut, kClvSplitBit | uint(level.splits.size())), "a split below"));
    EXPECT_TRUE(names(complaintOfWord("split links", 4 * root, level.table[cut]), "splits that end"));       // a circle
    EXPECT_TRUE(names(complaintOfWord("split links", 4 * root, uint(level.slots.size() - 1)), "splits that end"));
    EXPECT_TRUE(names(complaintOfWord("split links", 4 * root + 2, 0xfffffff0u), "slots"));
    EXPECT_TRUE(names(complaintOfWord("split links", 4 * root + 3, 0), "slots"));
    EXPECT_TRUE(names(complaintOfWord("split links", 4 * root + 3, 5), "slots"));
    EXPECT_TRUE(names(complaintOfWord("split plane", 4 * root, 0x7fc00000u), "splits that end"));
    EXPECT_TRUE(names(complaintOfWord("slot cell", 0, 100000), "one cell that it belongs to"));
}

TEST_F(DamagedVolume, piecesOfTwoVolumesAreToldApart) {
    BakedVolume later = hallVolume();
    std::filesystem::create_directories(folder_ / "W");
    const auto pathOf = [this](const std::string& name) { return file(name); };
    writeVolume("V.vtm", later, pathOf);
    later.frame += 1;
    writeVolume("W.vtm", later, pathOf);
    std::filesystem::copy_file(file("W/cascade_1.vti"), file("V/cascade_1.vti"), std::filesystem::copy_options::overwrite_existing);
    EXPECT_NE(complaint().find("cascade_1.vti: expected a piece of the same volume"), std::string::npos);
    std::filesystem::copy_file(file("W/cascade_0.vti"), file("V/cascade_0.vti"), std::filesystem::copy_options::overwrite_existing);
    EXPECT_NE(complaint().find("cascade_0.vti: expected a piece of the volume that"), std::string::npos) << "all of them are another's";
}

TEST_F(DamagedVolume, aPieceInThePlaceOfAnotherIsSeen) {
    writeVolume("V.vtm", hallVolume(), [this](const std::string& name) { return file(name); });
    std::filesystem::copy_file(file("V/cascade_0.vti"), file("V/cascade_1.vti"), std::filesystem::copy_options::overwrite_existing);
    EXPECT_NE(complaint().find("cascade_1.vti: expected cascade 1"), std::string::npos);
}

}  // namespace
