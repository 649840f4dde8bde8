// Output files appear complete or not at all.
#include "bindings/cli/staged_output.h"

#include "bindings/scene/scene.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using Names = std::vector<std::string>;

class Staged : public TemporaryFolder {};

TEST_F(Staged, filesAppearOnCommitAndNothingElseStays) {
    {
        StagedOutput output(folder_);
        std::ofstream(output.path("a.txt")) << "a";
        std::ofstream(output.path("b.txt")) << "b";
        EXPECT_FALSE(std::filesystem::exists(file("a.txt")));
        output.commit();
    }
    EXPECT_EQ(listing(), (Names{"a.txt", "b.txt"}));
    EXPECT_EQ(read(file("b.txt")), "b");
}

TEST_F(Staged, namesMayBeginWithAFolderAndBeAskedForTwice) {
    write("taken", "");
    StagedOutput output(folder_);
    std::ofstream(output.path("set/piece.txt")) << "first";
    std::ofstream(output.path("set/piece.txt")) << "again";
    EXPECT_THROW(output.path("taken/piece.txt"), InputError);
    EXPECT_FALSE(std::filesystem::exists(file("set")));
    output.commit();
    EXPECT_EQ(listing("set"), Names{"piece.txt"});
    EXPECT_EQ(read(file("set/piece.txt")), "again");
}

TEST_F(Staged, withoutCommitTheOldFileStaysAsItWas) {
    write("a.txt", "old");
    {
        StagedFile output(file("a.txt"));
        std::ofstream(output.path()) << "new";
    }
    EXPECT_EQ(listing(), Names{"a.txt"});
    EXPECT_EQ(read(file("a.txt")), "old");
}

TEST_F(Staged, commitReplacesTheOldFile) {
    write("a.txt", "old");
    StagedFile output(file("a.txt"));
    std::ofstream(output.path()) << "new";
    output.commit();
    EXPECT_EQ(read(file("a.txt")), "new");
}

TEST_F(Staged, aLinkStaysAndItsFileIsReplaced) {
    std::filesystem::create_directory(file("far"));
    write("far/a.txt", "old");
    std::filesystem::create_symlink("far/a.txt", file("a.txt"));
    std::filesystem::create_symlink("far/b.txt", file("b.txt"));
    for (const char* name : {"a.txt", "b.txt"}) {
        StagedFile output(file(name));
        std::ofstream(output.path()) << "new";
        output.commit();
        EXPECT_TRUE(std::filesystem::is_symlink(file(name)));
        EXPECT_EQ(read(file(std::string("far/") + name)), "new");
    }
    EXPECT_EQ(listing("far"), (Names{"a.txt", "b.txt"}));
}

TEST_F(Staged, messagesNameFilesAsTheyWereToBeCalled) {
    StagedOutput output(folder_);
    EXPECT_EQ(withFinalNames(output.path("a.txt") + ": no room"), file("a.txt") + ": no room");
    EXPECT_EQ(withFinalNames("a.clv: .clv-1"), "a.clv: .clv-1");
}

TEST_F(Staged, aPlaceThatCannotBeWrittenIsRefusedAtOnce) {
    EXPECT_THROW(StagedFile(file("missing/a.txt")), InputError);
    write("plain", "");
    EXPECT_THROW(StagedFile(file("plain/a.txt")), InputError);
    EXPECT_THROW(StagedFile(file("")), InputError);
    EXPECT_EQ(listing(), Names{"plain"});
}

TEST_F(Staged, foldersAndDevicesAreNotReplaced) {
    std::filesystem::create_directory(file("folder"));
    EXPECT_THROW(StagedFile(file("folder")), InputError);
    EXPECT_THROW(StagedFile("/dev/null"), InputError);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
