// Every technique folder is on the list, and holds what a technique is made of.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/8_rules/the_list.h"

namespace strata {
namespace {

const std::filesystem::path passes = std::filesystem::path(STRATA_SOURCE_DIR) / "passes";

TEST(Folders, EveryTechniqueFolderIsOnTheListAndEveryLineHasItsFolder) {
    std::vector<std::string> listed = listed_techniques();
    std::ranges::sort(listed);
    EXPECT_EQ(technique_folders(), listed);
}

TEST(Folders, EveryTechniqueHasItsReadmeItsModelItsFactsAndItself) {
    for (const std::string& technique : technique_folders()) {
        const std::string own = std::filesystem::path(technique).filename().string();
        for (const std::string& file : {std::string("README.md"), std::string("model.cpp"), own + ".cpp", own + "_test.cpp"})
            EXPECT_TRUE(std::filesystem::exists(passes / technique / file))
                << "passes/" << technique << "/" << file << " is missing";
    }
}

TEST(Folders, EveryStageWithTechniquesHasATruthAndAJudge) {
    for (const std::string& technique : technique_folders()) {
        const std::filesystem::path stage = std::filesystem::path(technique).parent_path();
        for (const char* file : {"truth.h", "truth.cpp", "judge.h", "judge.cpp"})
            EXPECT_TRUE(std::filesystem::exists(passes / stage / file))
                << "passes/" << stage.string() << "/" << file << " is missing";
    }
}

TEST(Folders, EveryReadmeSaysHowTheTechniqueFails) {
    for (const std::string& technique : technique_folders()) {
        const std::filesystem::path readme = passes / technique / "README.md";
        EXPECT_TRUE(std::filesystem::exists(readme) && std::filesystem::file_size(readme) > 500)
            << readme << " is missing or has less than 500 characters";
    }
}

}  // namespace
}  // namespace strata
