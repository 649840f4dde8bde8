// Point files: what is accepted, what is refused and with which words, and what is written.
#include "bindings/cli/point_table.h"

#include <limits>

#include "support/temporary_folder.h"

namespace point_table_test {

using namespace clv;

const std::string kHeader = "px,py,pz,nx,ny,nz\n";

class PointTableFile : public TemporaryFolder {
protected:
    PointTable parse(const std::string& text, const glm::dvec3& anchor = glm::dvec3(0.0)) const {
        return readPointTable(write("p.csv", text), anchor);
    }
    // What is said about a file that is refused.
    std::string complaint(const std::string& text) const {
        try {
            parse(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }
};

TEST_F(PointTableFile, rowsBecomePointsInOrder) {
    const PointTable table = parse(kHeader + "1,2.5,-3e0,0,1,0\n0.1,0,0,0,0,-1\n");
    ASSERT_EQ(table.points.size(), 2u);
    EXPECT_EQ(table.points[0].position, glm::vec3(1.0f, 2.5f, -3.0f));
    EXPECT_EQ(table.points[0].normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(table.points[1].position, glm::vec3(0.1f, 0, 0));
    EXPECT_EQ(table.rows[0], "1,2.5,-3e0,0,1,0");
}

TEST_F(PointTableFile, positionsFarFromTheOriginKeepTheirMillimetres) {
    const PointTable table = parse(kHeader + "1000000.001,0,0,0,1,0\n", glm::dvec3(1e6, 0, 0));
    EXPECT_NEAR(table.points[0].position.x, 1e-3f, 1e-9f);
}

TEST_F(PointTableFile, windowsLineEndsBlankLinesAndAByteOrderMarkAreAccepted) {
    const PointTable table = parse("\xef\xbb\xbfpx,py,pz,nx,ny,nz\r\n0,0,0, 0, 1 ,0\r\n\r\n1,0,0,0,1,0");
    ASSERT_EQ(table.points.size(), 2u);
    EXPECT_EQ(table.rows[0], "0,0,0, 0, 1 ,0");
    EXPECT_EQ(table.points[0].normal, glm::vec3(0, 1, 0));
}

TEST_F(PointTableFile, normalsWithinATenthOfAPercentAreAcceptedAndMadeUnit) {
    const PointTable table = parse(kHeader + "0,0,0,0,1.0009,0\n");
    EXPECT_EQ(table.points[0].normal, glm::vec3(0, 1, 0));
    EXPECT_NE(complaint(kHeader + "0,0,0,0,1.0011,0\n"), "accepted");
    EXPECT_NE(complaint(kHeader + "0,0,0,0,0.9989,0\n"), "accepted");
}

TEST_F(PointTableFile, linesWithoutEndAndBytesOfZeroAreRefused) {
    EXPECT_EQ(complaint(std::string(1 << 20, 'x')), file("p.csv") + ":1: expected at most 4000 characters");
    EXPECT_EQ(complaint(kHeader + "0,0,0,0,1,0\n" + std::string(4001, ' ') + "0,0,0,0,1,0\n"), file("p.csv") + ":3: expected at most 4000 characters");
    EXPECT_EQ(parse(kHeader + std::string(3989, ' ') + "0,0,0,0,1,0").points.size(), 1u);
    EXPECT_NE(complaint(kHeader + "0,0,0,0,1,0" + std::string(1, '\0') + ",7\n"), "accepted");
}

TEST_F(PointTableFile, refusalsNameTheFileTheLineAndWhatWasExpected) {
    const std::string p = file("p.csv");
    const std::string good = "0,0,0,0,1,0\n";
    EXPECT_EQ(complaint("x,y,z\n"), p + ":1: expected the header px,py,pz,nx,ny,nz");
    EXPECT_EQ(complaint(""), p + ":1: expected the header px,py,pz,nx,ny,nz");
    EXPECT_EQ(complaint(kHeader), p + ":2: expected at least one point below the header");
    EXPECT_EQ(complaint(kHeader + good + "0,0,0,0,1\n"), p + ":3: expected 6 columns, px,py,pz,nx,ny,nz, found 5");
    EXPECT_EQ(complaint(kHeader + "0,0,0,0,1,0,0\n"), p + ":2: expected 6 columns, px,py,pz,nx,ny,nz, found 7");
    EXPECT_EQ(complaint(kHeader + "0,0,zero,0,1,0\n"), p + ":2: column 3: expected a finite number, found \"zero\"");
    EXPECT_EQ(complaint(kHeader + "0,0,1.5m,0,1,0\n"), p + ":2: column 3: expected a finite number, found \"1.5m\"");
    EXPECT_EQ(complaint(kHeader + "nan,0,0,0,1,0\n"), p + ":2: column 1: expected a finite number, found \"nan\"");
    EXPECT_EQ(complaint(kHeader + "0,inf,0,0,1,0\n"), p + ":2: column 2: expected a finite number, found \"inf\"");
    EXPECT_EQ(complaint(kHeader + "0,,0,0,1,0\n"), p + ":2: column 2: expected a finite number, found \"\"");
    EXPECT_EQ(complaint(kHeader + "0,-1.1e12,0,0,1,0\n"), p + ":2: expected coordinates of at most 1e+12 m, found -1.1e+12");
    EXPECT_EQ(complaint(kHeader + "0,-1e12,0,0,1,0\n"), "accepted");
    EXPECT_EQ(complaint(kHeader + good + good + "0,0,0,0,2,0\n"), p + ":4: expected a normal of unit length, found length 2");
    EXPECT_EQ(complaint(kHeader + "0,0,0,0,0,0\n"), p + ":2: expected a normal of unit length, found length 0");
    EXPECT_EQ(complaint(kHeader + "0,0,0,1e200,0,0\n"), p + ":2: expected a normal of unit length, found length inf");
}

TEST_F(PointTableFile, aMissingFileAndAFolderAreRefused) {
    EXPECT_THROW(readPointTable(file("none.csv"), glm::dvec3(0.0)), InputError);
    EXPECT_THROW(readPointTable(folder_.string(), glm::dvec3(0.0)), InputError);
}

TEST_F(PointTableFile, writtenRowsRepeatTheInputAndReadBackToTheSameFloats) {
    const PointTable table = parse(kHeader + "1.50,0,0.0e0,0,1,0\r\n");
    const std::vector<glm::vec3> values = {{0.1f, 1.0f / 3.0f, std::numeric_limits<float>::denorm_min()}}, more = {{1, 2, 1e30f}};
    writePointTable(file("r.csv"), table, {{"E_r,E_g,E_b", values}, {"s_r,s_g,s_b", more}});
    EXPECT_EQ(read(file("r.csv")), "px,py,pz,nx,ny,nz,E_r,E_g,E_b,s_r,s_g,s_b\n1.50,0,0.0e0,0,1,0,0.1,0.33333334,1e-45,1,2,1e+30\n");
}

TEST_F(PointTableFile, aDiskThatIsFullIsAnError) {
    const PointTable table = parse(kHeader + "0,0,0,0,1,0\n");
    const std::vector<glm::vec3> values(1);
    EXPECT_THROW(writePointTable("/dev/full", table, {{"E_r,E_g,E_b", values}}), std::runtime_error);
}

}  // namespace point_table_test
