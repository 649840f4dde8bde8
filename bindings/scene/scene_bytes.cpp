#include "bindings/scene/scene_bytes.h"

#include <type_traits>

#include "bindings/scene/worker_process.h"

namespace clv {
namespace {

// Visits every member, in the same order for both ways; `Value` is const where it is written.
template <class Pipe, class Value>
void visit(Pipe& pipe, Value& value) {
    using Kind = std::remove_const_t<Value>;
    if constexpr (std::is_same_v<Kind, std::string>) {
        pipe(value);
    } else if constexpr (std::is_same_v<Kind, Texture>) {
        pipe(value.name), pipe(value.width), pipe(value.height), pipe(value.texels);
    } else if constexpr (std::is_same_v<Kind, Material>) {
        pipe(value.name), pipe(value.albedo), pipe(value.texture);
    } else if constexpr (std::is_same_v<Kind, Camera>) {
        pipe(value.name), pipe(value.position), pipe(value.forward), pipe(value.up), pipe(value.yfov), pipe(value.aspect);
    } else if constexpr (std::is_same_v<Kind, NamedLight>) {
        pipe(value.name), pipe(value.light);
    } else {
        static_assert(std::is_same_v<Kind, Scene>);
        pipe(value.name), pipe(value.anchor), pipe(value.positions), pipe(value.uvs), pipe(value.triangles), pipe(value.materialOf), pipe(value.nodeOf);
        pipe(value.nodeNames), pipe(value.materials), pipe(value.textures), pipe(value.lights), pipe(value.cameras), pipe(value.bounds);
        pipe(value.ignored), pipe(value.warnings), pipe(value.droppedTriangles);
    }
}

class Writer {
public:
    explicit Writer(int out) : out_(out) {}

    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(const Value& value) {
        writeAll(out_, &value, sizeof value);
    }
    template <class Value>
    void operator()(const std::vector<Value>& values) {
        (*this)(values.size());
        if constexpr (std::is_trivially_copyable_v<Value>) {
            writeAll(out_, values.data(), values.size() * sizeof(Value));
        } else {
            for (const Value& value : values) visit(*this, value);
        }
    }
    void operator()(const std::string& text) {
        (*this)(text.size());
        writeAll(out_, text.data(), text.size());
    }

private:
    int out_;
};

class Reader {
public:
    explicit Reader(int in) : in_(in) {}

    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(Value& value) {
        readAll(in_, &value, sizeof value);
    }
    template <class Value>
    void operator()(std::vector<Value>& values) {
        std::size_t count = 0;
        (*this)(count);
        values.resize(count);
        if constexpr (std::is_trivially_copyable_v<Value>) {
            readAll(in_, values.data(), values.size() * sizeof(Value));
        } else {
            for (Value& value : values) visit(*this, value);
        }
    }
    void operator()(std::string& text) {
        std::size_t count = 0;
        (*this)(count);
        text.resize(count);
        readAll(in_, text.data(), text.size());
    }

private:
    int in_;
};

}  // namespace

void writeScene(int out, const Scene& scene) {
    Writer writer(out);
    visit(writer, scene);
}

Scene readScene(int in) {
    Reader reader(in);
    Scene scene;
    visit(reader, scene);
    return scene;
}

void writeText(int out, const std::string& text) { Writer{out}(text); }

std::string readText(int in) {
    std::string text;
    Reader{in}(text);
    return text;
}

}  // namespace clv
