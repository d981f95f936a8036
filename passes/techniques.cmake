# add_techniques(target stage/name...): compiles all shaders, collects every *_test.cpp for the test programs, and writes what must
# know all techniques: the table, the embedded shaders with their sources and the G-buffer decoders and
# encoders.

set(generated_passes ${CMAKE_BINARY_DIR}/generated/passes)

# How a program that compiles changed shaders calls glslangValidator (embedded in it). compile_shaders does the same.
set(glsl_options --quiet --target-env vulkan1.3)

# A SPIR-V file from each GLSL file below the folder, all of them rebuilt when one of them or anything they include changes: what
# depends on shaders/compiled. Sets spirv_list.
function(compile_shaders spirv_list)
    add_executable(compile_shaders shaders/compiler/compile_shaders.cpp)
    target_compile_features(compile_shaders PRIVATE cxx_std_20)
    target_link_libraries(compile_shaders PRIVATE glslang::SPIRV glslang::glslang-default-resource-limits)
    file(GLOB_RECURSE names CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.comp *.vert *.geom *.frag)
    set(folder ${CMAKE_BINARY_DIR}/shaders)
    foreach(name IN LISTS names)
        get_filename_component(home ${folder}/${name} DIRECTORY)
        file(MAKE_DIRECTORY ${home})
    endforeach()
    list(JOIN names "\n" lines)
    file(CONFIGURE OUTPUT ${folder}/names CONTENT "${lines}\n" @ONLY)
    add_custom_command(
        OUTPUT ${folder}/compiled
        COMMAND compile_shaders ${folder}/names ${CMAKE_CURRENT_SOURCE_DIR} ${folder} ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/generated
        DEPENDS compile_shaders ${folder}/names DEPFILE ${folder}/compiled.d
        COMMENT "GLSL")
    list(TRANSFORM names PREPEND ${folder}/)
    list(TRANSFORM names APPEND .spv)
    set(${spirv_list} ${names} PARENT_SCOPE)
endfunction()

# Files in one assembly file (.incbin), each between the symbols strata_<kind>_<index> and strata_<kind>_<index>_end; made anew
# when one of the files made_by changes.
function(embed_files target kind made_by)
    set(assembly ".section .rodata\n")
    set(index 0)
    foreach(file IN LISTS ARGN)
        string(APPEND assembly ".balign 4\n.global strata_${kind}_${index}\n.global strata_${kind}_${index}_end\n"
            "strata_${kind}_${index}:\n.incbin \"${file}\"\nstrata_${kind}_${index}_end:\n")
        math(EXPR index "${index} + 1")
    endforeach()
    string(APPEND assembly ".section .note.GNU-stack,\"\",@progbits\n")
    file(CONFIGURE OUTPUT ${generated_passes}/embedded_${kind}s.S CONTENT "${assembly}" @ONLY)
    set_source_files_properties(${generated_passes}/embedded_${kind}s.S PROPERTIES OBJECT_DEPENDS "${made_by}")
    target_sources(${target} PRIVATE ${generated_passes}/embedded_${kind}s.S)
endfunction()

# All shaders and a C++ table of their names.
function(embed_shaders target)
    embed_files(${target} shader ${CMAKE_BINARY_DIR}/shaders/compiled ${ARGN})
    set(externs "")
    set(rows "")
    set(index 0)
    foreach(spirv IN LISTS ARGN)
        file(RELATIVE_PATH name ${CMAKE_BINARY_DIR}/shaders ${spirv})
        string(REGEX REPLACE "\\.spv$" "" name ${name})
        string(APPEND externs "extern const std::uint32_t strata_shader_${index}[], strata_shader_${index}_end[];\n")
        string(APPEND rows "    {\"${name}\", {strata_shader_${index}, strata_shader_${index}_end}},\n")
        math(EXPR index "${index} + 1")
    endforeach()
    file(CONFIGURE OUTPUT ${generated_passes}/embedded_shaders.cpp CONTENT
"// Written by passes/techniques.cmake.
#include \"passes/graph/shader.h\"

extern \"C\" {
${externs}}

namespace strata {
std::span<const EmbeddedShader> embedded_shaders() {
    static const EmbeddedShader table[] = {
${rows}    };
    return table;
}
}  // namespace strata
" @ONLY)
    target_sources(${target} PRIVATE ${generated_passes}/embedded_shaders.cpp)
endfunction()

# The GLSL of all shaders, what it includes, and how it is compiled.
function(embed_sources target)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.comp *.vert *.geom *.frag *.glsl *.shared.h shader_interop.h)
    set(generated ${generated_passes}/gbuffer/decoders.glsl ${generated_passes}/gbuffer/encoders.glsl)
    list(APPEND sources ${generated})
    embed_files(${target} source "${sources}" ${sources})
    set(externs "")
    set(rows "")
    set(index 0)
    foreach(source IN LISTS sources)
        file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${source})
        if(source IN_LIST generated)
            file(RELATIVE_PATH name ${CMAKE_BINARY_DIR}/generated ${source})
        endif()
        string(APPEND externs "extern const char strata_source_${index}[], strata_source_${index}_end[];\n")
        string(APPEND rows "    {\"${name}\", {strata_source_${index}, strata_source_${index}_end}},\n")
        math(EXPR index "${index} + 1")
    endforeach()
    list(JOIN glsl_options "\", \"" options)
    file(CONFIGURE OUTPUT ${generated_passes}/embedded_sources.cpp CONTENT
"// Written by passes/techniques.cmake.
#include \"passes/graph/shader_sources.h\"

extern \"C\" {
${externs}}

namespace strata {
std::span<const ShaderSource> shader_sources() {
    static const ShaderSource table[] = {
${rows}    };
    return table;
}
std::span<const char* const> glsl_options() {
    static constexpr const char* options[] = {\"${options}\"};
    return options;
}
}  // namespace strata
" @ONLY)
    target_sources(${target} PRIVATE ${generated_passes}/embedded_sources.cpp)
endfunction()

# write_table(target name type header namespace/function...): defines name(), which returns what every function returns, in the
# list's order.
function(write_table target name type header)
    set(declarations "")
    set(rows "")
    foreach(entry IN LISTS ARGN)
        get_filename_component(namespace ${entry} DIRECTORY)
        get_filename_component(function ${entry} NAME)
        string(APPEND declarations "namespace ${namespace} { ${type} ${function}(); }\n")
        string(APPEND rows "        ${namespace}::${function}(),\n")
    endforeach()
    file(CONFIGURE OUTPUT ${generated_passes}/${name}.cpp CONTENT
"// Written by passes/techniques.cmake from the list in passes/CMakeLists.txt.
#include \"${header}\"

namespace strata {
${declarations}
std::vector<${type}> ${name}() {
    return {
${rows}    };
}
}  // namespace strata
" @ONLY)
    target_sources(${target} PRIVATE ${generated_passes}/${name}.cpp)
endfunction()

# add_stages(target name...): each folder's stage.cpp, the enumeration of stages with their names, and their table.
function(add_stages target)
    list(JOIN ARGN ",\n    " enumerators)
    list(JOIN ARGN "\",\n    \"" names)
    file(CONFIGURE OUTPUT ${generated_passes}/stage.h CONTENT
"// Written by passes/techniques.cmake from the list in passes/CMakeLists.txt.
#pragma once

#include <cstdint>
#include <string_view>

namespace strata {

enum class Stage : std::uint32_t {
    ${enumerators},
    count_,
};

inline constexpr std::string_view stage_names[] = {
    \"${names}\",
};

}  // namespace strata
" @ONLY)
    list(TRANSFORM ARGN APPEND /stage)
    write_table(${target} stage_table StageInfo passes/stages.h ${ARGN})
endfunction()

# Switches over the decode.glsl and over the pack.glsl of every G-buffer technique, in the list's order (index_in_stage).
function(write_gbuffer_coders)
    foreach(kind decode pack)
        set(${kind}_includes "")
        set(${kind}_cases "")
    endforeach()
    set(index 0)
    foreach(technique IN LISTS ARGN)
        get_filename_component(stage ${technique} DIRECTORY)
        get_filename_component(name ${technique} NAME)
        if(stage STREQUAL "gbuffer")
            string(APPEND decode_includes "#include \"passes/${technique}/decode.glsl\"\n")
            string(APPEND decode_cases "    if (layout_index == ${index}u) return decode_${name}(t);\n")
            string(APPEND pack_includes "#include \"passes/${technique}/pack.glsl\"\n")
            string(APPEND pack_cases "    if (layout_index == ${index}u) return pack_${name}(m);\n")
            math(EXPR index "${index} + 1")
        endif()
    endforeach()
    file(CONFIGURE OUTPUT ${generated_passes}/gbuffer/decoders.glsl CONTENT
"// Written by passes/techniques.cmake: every G-buffer technique's decode.glsl.
${decode_includes}
Surface decode_gbuffer(uint layout_index, GBufferTexel t) {
${decode_cases}    return no_surface();
}
" @ONLY)
    file(CONFIGURE OUTPUT ${generated_passes}/gbuffer/encoders.glsl CONTENT
"// Written by passes/techniques.cmake: every G-buffer technique's pack.glsl.
${pack_includes}
GBufferWords pack_gbuffer(uint layout_index, MaterialPoint m) {
${pack_cases}    return GBufferWords(vec4(0.0), vec4(0.0), vec4(0.0));
}
" @ONLY)
endfunction()

function(add_techniques target)
    foreach(technique IN LISTS ARGN)
        get_filename_component(name ${technique} NAME)
        set(source ${CMAKE_CURRENT_SOURCE_DIR}/${technique}/${name}.cpp)
        if(NOT EXISTS ${source})
            message(FATAL_ERROR "technique ${technique} is on the list in passes/CMakeLists.txt, but there is no ${source}")
        endif()
    endforeach()
    write_table(${target} technique_table Technique passes/technique.h ${ARGN})
    write_gbuffer_coders(${ARGN})

    compile_shaders(spirv)
    embed_shaders(${target} ${spirv})
    embed_sources(${target})
    file(GLOB_RECURSE tests CONFIGURE_DEPENDS *_test.cpp)
    set_property(GLOBAL PROPERTY strata_technique_tests ${tests})
endfunction()
