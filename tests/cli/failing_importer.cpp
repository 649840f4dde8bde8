// Stands before assimp, loaded ahead of it: reading a file fails as CLV_FAILING_IMPORTER says.
#include <csignal>
#include <cstdlib>
#include <new>
#include <string_view>

#include <assimp/Importer.hpp>
#include <unistd.h>

namespace {

void fail() {
    const char* how = std::getenv("CLV_FAILING_IMPORTER");
    const std::string_view way = how ? how : "";
    if (way == "crash") std::raise(SIGSEGV);
    if (way == "abort") std::abort();
    if (way == "leave") _exit(0);
    if (way == "eat") throw std::bad_alloc();
}

}  // namespace

const aiScene* Assimp::Importer::ReadFile(const char*, unsigned int) { return fail(), nullptr; }
const aiScene* Assimp::Importer::ReadFileFromMemory(const void*, std::size_t, unsigned int, const char*) { return fail(), nullptr; }
