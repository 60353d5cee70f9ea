# cmake -P EmbedTexts.cmake -- OUTPUT NAME=FILE[+FILE...] ...: writes a C++ file that holds the texts, those of
# several files one after the other. For source/report/html/resources.h.
set(arguments "")
set(found FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(found)
    list(APPEND arguments "${CMAKE_ARGV${i}}")
  elseif(CMAKE_ARGV${i} STREQUAL "--")
    set(found TRUE)
  endif()
endforeach()
list(POP_FRONT arguments output)

set(arrays "")
set(entries "")
foreach(argument ${arguments})
  string(FIND "${argument}" "=" equals)
  string(SUBSTRING "${argument}" 0 ${equals} name)
  math(EXPR start "${equals} + 1")
  string(SUBSTRING "${argument}" ${start} -1 files)
  string(REPLACE "+" ";" files "${files}")
  set(bytes "")
  foreach(file ${files})
    file(READ ${file} more HEX)
    string(APPEND bytes "${more}0a")
  endforeach()
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "${name}" symbol)
  string(APPEND arrays "constexpr unsigned char text_${symbol}[] = {${bytes}0};\n")
  string(APPEND entries "    {\"${name}\", text_${symbol}, sizeof(text_${symbol}) - 1},\n")
endforeach()
file(WRITE ${output} "// Made by external/cmake/EmbedTexts.cmake.
#include \"report/html/resources.h\"

#include <cassert>
#include <cstddef>

namespace strandlab {
namespace {
${arrays}
struct Entry {
    std::string_view name;
    const unsigned char* text;
    size_t size;
};
const Entry entries[] = {
${entries}};
}  // namespace

std::string_view resource(std::string_view name) {
    for (const Entry& entry : entries)
        if (entry.name == name) return {reinterpret_cast<const char*>(entry.text), entry.size};
    assert(false && \"no such resource\");
    return {};
}

}  // namespace strandlab
")
