#include "scene_examples.hpp"

#include <filesystem>
#include <fstream>
#include <map>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;
using bem::Scene;

namespace {

/// A folder with files, which goes with it.
class Folder {
 public:
  explicit Folder(const std::map<std::string, std::string>& files) {
    std::string name = (fs::temp_directory_path() / "bem_includes_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    root_ = name;
    for (const auto& [path, text] : files) {
      fs::create_directories((root_ / path).parent_path());
      std::ofstream(root_ / path) << text;
    }
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(root_); }

  std::string path(const std::string& name) const { return (root_ / name).string(); }
  Scene scene() const { return bem::read_scene(path("scene.json")); }

  /// The message without the folder.
  std::string error() const {
    std::string message = bem::test::message_of([&] { scene(); });
    const std::string prefix = root_.string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
      message.erase(at, prefix.size());
    return message;
  }

 private:
  fs::path root_;
};

const std::string kTiming = "\"version\": 1, \"time_step\": 0.01, \"duration\": 1";
const std::string kPlane = "\"plane\": {\"point\": [0, 0, 0], \"normal\": [0, 1, 0]}";

}  // namespace

TEST_CASE("a scene includes others: its members win, lists of things are joined") {
  const Folder folder(
      {{"scene.json",
        "{\"include\": [\"parts/a.json\", \"b.json\"], \"duration\": 2,\n"
        "\"contact\": {\"tolerance\": 2},\n"
        "\"bodies\": [{\"name\": \"own\", \"archive\": \"own.bem\"}]}"},
       {"parts/a.json", "{" + kTiming +
                            ", \"contact\": {\"tolerance\": 3, \"self\": true},\n"
                            "\"bodies\": [{\"name\": \"a\", \"archive\": \"a.bem\"}]}"},
       {"b.json",
        "{\"contact\": {\"self\": false}, \"include\": \"parts/c.json\",\n"
        "\"obstacles\": [{\"name\": \"b\", \"mesh\": \"b.obj\"}]}"},
       {"parts/c.json", "{\"obstacles\": [{\"name\": \"c\", \"mesh\": \"c.obj\"}]}"}});
  REQUIRE(folder.error() == "");
  const Scene scene = folder.scene();
  CHECK(scene.time_step == 0.01);
  CHECK(scene.duration == 2);
  CHECK(scene.contact.tolerance == 2);
  CHECK(scene.contact.self == false);  // of two included files the later one wins
  REQUIRE(scene.bodies.size() == 2);
  CHECK(scene.bodies[0].name == "a");
  CHECK(scene.bodies[1].name == "own");
  CHECK(scene.bodies[0].archive.resolved == folder.path("parts/a.bem"));
  CHECK(scene.bodies[1].archive.resolved == folder.path("own.bem"));
  REQUIRE(scene.obstacles.size() == 2);
  CHECK(scene.obstacles[0].name == "c");
  CHECK(std::get<bem::MeshObstacle>(scene.obstacles[0].shape).mesh.resolved ==
        folder.path("parts/c.obj"));
  CHECK(scene.files == std::vector<std::string>{folder.path("scene.json"),
                                                folder.path("parts/a.json"), folder.path("b.json"),
                                                folder.path("parts/c.json")});
}

TEST_CASE("bodies, obstacles and defaults include what several have in common") {
  const Folder folder(
      {{"scene.json",
        "{" + kTiming +
            ", \"defaults\": {\"body\": {\"include\": \"soft.json\", \"friction\": 0.1},\n"
            "\"obstacle\": {\"friction\": 0.7}},\n"
            "\"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\", \"friction\": 0.3},\n"
            "{\"name\": \"c\", \"include\": \"hard.json\", \"gravity\": true}],\n"
            "\"obstacles\": [{\"name\": \"o\", \"include\": \"floor.json\"}]}"},
       {"soft.json", "{\"archive\": \"soft.bem\", \"gravity\": false, \"friction\": 0.2}"},
       {"hard.json", "{\"archive\": \"hard.bem\", \"gravity\": false}"},
       {"floor.json", "{" + kPlane + "}"}});
  REQUIRE(folder.error() == "");
  const Scene scene = folder.scene();
  CHECK(scene.bodies[0].archive.resolved == folder.path("soft.bem"));
  CHECK(scene.bodies[0].gravity == false);
  CHECK(scene.bodies[0].friction == 0.1);
  CHECK(scene.bodies[1].friction == 0.3);
  CHECK(scene.bodies[2].archive.resolved == folder.path("hard.bem"));
  CHECK(scene.bodies[2].gravity == true);
  CHECK(scene.bodies[2].friction == 0.1);
  CHECK(scene.obstacles[0].friction == 0.7);
}

TEST_CASE("a default does not stand against another way to say it") {
  const std::string start =
      "{" + kTiming + ", \"defaults\": {\"body\": {\"archive\": \"x\", \"position\": [1, 2, 3], ";
  const Scene scene = bem::parse_scene(
      "s.json", start +
                    "\"rotation\": {\"axis\": [1, 0, 0], \"angle_deg\": 90}}, "
                    "\"obstacle\": {\"mesh\": \"m.obj\"}}, \"bodies\": [{\"name\": \"a\", "
                    "\"place\": {\"center\": [4, 5, 6]}},\n"
                    "{\"name\": \"b\", \"rotation\": {\"axis\": [0, 1, 0], \"angle_deg\": 0}}],\n"
                    "\"obstacles\": [{\"name\": \"p\", " +
                    kPlane + "}, {\"name\": \"q\"}]}");
  CHECK(scene.bodies[0].place->centre == bem::Vec3(4, 5, 6));
  CHECK(scene.bodies[1].position == bem::Vec3(1, 2, 3));
  CHECK(scene.bodies[1].rotation.axis == bem::Vec3(0, 1, 0));
  CHECK(scene.obstacles[0].shape.index() == 0);
  CHECK(scene.obstacles[1].shape.index() == 1);
}

TEST_CASE("errors name the file that the mistake is in") {
  const std::string bodies = ", \"bodies\": [{\"name\": \"a\", \"archive\": \"a.bem\"}]";
  const std::string scene = "{\"include\": \"base.json\"" + bodies + "}";
  const auto with_base = [&](const std::string& base) {
    return Folder({{"scene.json", scene}, {"base.json", base}}).error();
  };
  CHECK(with_base("{" + kTiming + ",\n\"contact\": {\"tolerance\": 0}}") ==
        "base.json:2:26: /contact/tolerance: expected a length > 0, found the number 0");
  CHECK(with_base("{" + kTiming + ",\n\"contcat\": {}}")
            .find("base.json:2:1: /contcat: unknown key; did you mean \"contact\"?") == 0);
  CHECK(
      with_base("{" + kTiming + ",\n\"defaults\": {\"body\": {\"frictoin\": 1}}}")
          .find(
              "base.json:2:23: /defaults/body/frictoin: unknown key; did you mean \"friction\"?") ==
      0);
  CHECK(with_base("{" + kTiming + ",\n\"defaults\": {\"bdoy\": {}}}")
            .find("base.json:2:14: /defaults/bdoy: unknown key; did you mean \"body\"?") == 0);
  CHECK(with_base("{" + kTiming + "\n").find("base.json:2:1: not valid JSON") == 0);
  CHECK(with_base("[1]") ==
        "base.json:1:1: expected an object to include, found an array of length 1");
  CHECK(with_base("{" + kTiming + ", \"bodies\": 1}") ==
        "base.json:1:60: /bodies: expected an array of bodies, found the number 1");
  CHECK(with_base("{" + kTiming + bodies + "}") ==
        "scene.json:1:46: /bodies/0/name: the name \"a\" is already used at base.json:1:70: "
        "/bodies/0/name");
  CHECK(with_base("{\"version\": 1}") ==
        "scene.json:1:1: the required key \"duration\" is missing");
}

TEST_CASE("includes that lead nowhere or to themselves are refused") {
  const auto with = [](const std::string& include,
                       const std::map<std::string, std::string>& more = {}) {
    std::map<std::string, std::string> files = more;
    files["scene.json"] = "{\"include\": " + include + "}";
    return Folder(files).error();
  };
  CHECK(with("\"no.json\"") ==
        "scene.json:1:13: /include: the file \"no.json\" to include does not exist (no.json)");
  CHECK(with("[\"./folder\"]", {{"folder/x", ""}}) ==
        "scene.json:1:14: /include/0: the file \"./folder\" to include is no regular file "
        "(./folder)");
  CHECK(with("7") == "scene.json:1:13: /include: expected a string, found the number 7");
  CHECK(with("\"scene.json\"") ==
        "scene.json:1:13: /include: the file \"scene.json\" includes itself: scene.json -> "
        "scene.json");
  CHECK(with("\"a/a.json\"", {{"a/a.json", "{\"include\":\n\"../b.json\"}"},
                              {"b.json", "{\"bodies\": [{\"include\": \"a/../scene.json\"}]}"}}) ==
        "a/../b.json:1:25: /bodies/0/include: the file \"a/../scene.json\" includes itself: "
        "scene.json -> a.json -> b.json -> scene.json");
  std::map<std::string, std::string> chain;
  for (int i = 0; i < 60; ++i)
    chain[std::to_string(i)] = "{\"include\": \"" + std::to_string(i + 1) + "\"}";
  CHECK(with("\"0\"", chain) == "49:1:13: /include: includes are nested more than 50 deep");
}

TEST_CASE("files that include each other many times do not grow without bound") {
  std::map<std::string, std::string> files;
  for (int i = 0; i < 40; ++i) {
    const std::string next = "\"" + std::to_string(i + 1) + "\"";
    files[std::to_string(i)] = "{\"include\": [" + next + ", " + next + "]}";
  }
  files["40"] = "{\"bodies\": [1, 2, 3]}";
  files["scene.json"] = files["0"];
  CHECK(Folder(files).error().find("the scene becomes too large") != std::string::npos);
}

TEST_CASE("a path with backslashes is answered with the file that slashes lead to") {
  const auto scene = [](const std::string& path) {
    return "{" + kTiming + ", \"bodies\": [{\"name\": \"a\", \"archive\": \"" + path + "\"}]}";
  };
  const auto error = [&](const std::string& path) {
    return Folder({{"scene.json", scene(path)}, {"sub/a.bem", ""}, {"b\\c.bem", ""}}).error();
  };
  CHECK_THAT(error("sub\\\\a.bem"),
             Catch::Contains("there is no file \"sub\\a.bem\"; write \"sub/a.bem\""));
  CHECK(error("sub\\\\b.bem") == "");  // whatever reads it says that it is not there
  CHECK(error("b\\\\c.bem") == "");
}
