// A scene that another process reads is the scene, to the bit.
#include "bindings/scene/importer.h"

#include <array>
#include <cstring>

#include <unistd.h>

#include "bindings/scene/scene_bytes.h"
#include "support/temporary_folder.h"

using namespace clv;

namespace {

// Everything in a scene, as bytes.
std::string bytesOf(const Scene& scene) {
    std::FILE* file = std::tmpfile();
    writeScene(fileno(file), scene);
    std::string bytes(std::size_t(std::ftell(file) < 0 ? 0 : lseek(fileno(file), 0, SEEK_CUR)), '\0');
    lseek(fileno(file), 0, SEEK_SET);
    readAll(fileno(file), bytes.data(), bytes.size());
    std::fclose(file);
    return bytes;
}

Scene throughPipe(const Scene& scene) {
    std::FILE* file = std::tmpfile();
    writeScene(fileno(file), scene);
    lseek(fileno(file), 0, SEEK_SET);
    const Scene read = readScene(fileno(file));
    std::fclose(file);
    return read;
}

class Importer : public TemporaryFolder {
protected:
    std::string complaint(const std::string& file) {
        try {
            importApart(process, file);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
    WorkerProcess process{serveImport, {.seconds = 60}};
};

TEST(SceneBytes, keepEveryMember) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        Scene scene = makeBuiltinScene(builtin.name);
        scene.ignored = {"morph targets"}, scene.warnings = {"a.obj:2: no material"}, scene.droppedTriangles = 7, scene.anchor = glm::dvec3(1e7, 2.0, -3.0);
        const Scene read = throughPipe(scene);
        EXPECT_EQ(read.name, scene.name);
        EXPECT_EQ(read.anchor, scene.anchor);
        EXPECT_EQ(read.positions, scene.positions);
        EXPECT_EQ(read.uvs, scene.uvs);
        EXPECT_EQ(read.triangles, scene.triangles);
        EXPECT_EQ(read.materialOf, scene.materialOf);
        EXPECT_EQ(read.nodeOf, scene.nodeOf);
        EXPECT_EQ(read.nodeNames, scene.nodeNames);
        ASSERT_EQ(read.materials.size(), scene.materials.size());
        for (std::size_t k = 0; k < scene.materials.size(); ++k) {
            EXPECT_EQ(read.materials[k].name, scene.materials[k].name);
            EXPECT_EQ(read.materials[k].albedo, scene.materials[k].albedo);
            EXPECT_EQ(read.materials[k].texture, scene.materials[k].texture);
        }
        ASSERT_EQ(read.textures.size(), scene.textures.size());
        for (std::size_t k = 0; k < scene.textures.size(); ++k) {
            EXPECT_EQ(read.textures[k].name, scene.textures[k].name);
            EXPECT_EQ(read.textures[k].width, scene.textures[k].width);
            EXPECT_EQ(read.textures[k].height, scene.textures[k].height);
            EXPECT_EQ(read.textures[k].texels, scene.textures[k].texels);
        }
        ASSERT_EQ(read.lights.size(), scene.lights.size());
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            EXPECT_EQ(read.lights[k].name, scene.lights[k].name);
            EXPECT_EQ(std::memcmp(&read.lights[k].light, &scene.lights[k].light, sizeof(ClvLight)), 0);
        }
        ASSERT_EQ(read.cameras.size(), scene.cameras.size());
        for (std::size_t k = 0; k < scene.cameras.size(); ++k) {
            EXPECT_EQ(read.cameras[k].name, scene.cameras[k].name);
            EXPECT_EQ(read.cameras[k].position, scene.cameras[k].position);
            EXPECT_EQ(read.cameras[k].forward, scene.cameras[k].forward);
            EXPECT_EQ(read.cameras[k].up, scene.cameras[k].up);
            EXPECT_EQ(read.cameras[k].yfov, scene.cameras[k].yfov);
            EXPECT_EQ(read.cameras[k].aspect, scene.cameras[k].aspect);
        }
        EXPECT_EQ(read.bounds.lo, scene.bounds.lo);
        EXPECT_EQ(read.bounds.hi, scene.bounds.hi);
        EXPECT_EQ(read.ignored, scene.ignored);
        EXPECT_EQ(read.warnings, scene.warnings);
        EXPECT_EQ(read.droppedTriangles, scene.droppedTriangles);
    }
}

TEST_F(Importer, readsWhatThisProcessReads) {
    writeGlb(makeBuiltinScene("atrium"), file("atrium.glb"));
    write("square.obj", "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nf 1 2 3 4\n");
    for (const char* name : {"atrium.glb", "square.obj"}) EXPECT_EQ(bytesOf(importApart(process, file(name))), bytesOf(importScene(file(name)))) << name;
}

TEST_F(Importer, passesOnWhatIsWrongWithAFile) {
    const std::string bad = write("bad.obj", "v 0 0 nan\n");
    EXPECT_EQ(complaint(bad), bad + ":1: expected a vertex of 3, 4 or 6 finite numbers such as 0.5 or -1e3, not 'nan'");
    EXPECT_EQ(complaint(file("missing.glb")), file("missing.glb") + ": no such file");
}

}  // namespace
