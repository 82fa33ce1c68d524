#include "scene_examples.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using bem::test::scene_error;
using bem::test::scene_with;
using bem::test::scene_with_body;

namespace {

/// `text` with the first `from` replaced by `to`.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The error of a scene with the mark "@" at the place where the error must be reported, without
/// that place. A scene without a mark must be valid; its error is "".
std::string error_at_mark(std::string text) {
  const auto at = text.find('@');
  if (at == std::string::npos) return scene_error(text);
  text.erase(at, 1);
  const std::string before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  const std::string place = "s.json:" + std::to_string(line) + ':' + std::to_string(column) + ": ";
  const std::string message = scene_error(text);
  INFO(message);
  REQUIRE(message.substr(0, place.size()) == place);
  return message.substr(place.size());
}

std::string minimal(const std::string& from, const std::string& to) {
  return error_at_mark(changed(scene_with(""), from, to));
}

std::string body_error(const std::string& members) {
  return error_at_mark(scene_with_body("," + members));
}

std::string world_error(const std::string& members) {
  return error_at_mark(scene_with("," + members));
}

}  // namespace

TEST_CASE("the scenes that the errors are made from are valid") {
  REQUIRE(scene_error(scene_with("")) == "");
  REQUIRE(scene_error(scene_with_body("")) == "");
  REQUIRE(scene_error(bem::test::full_scene()) == "");
}

TEST_CASE("an unknown key is answered with the nearest valid one") {
  REQUIRE(body_error("@\"gravty\": true") ==
          "/bodies/0/gravty: unknown key; did you mean \"gravity\"? (allowed: name, archive, mesh, "
          "material, mesh_scale, precompute, render_mesh, place, position, rotation, velocity, "
          "angular_velocity, frame, correction, gravity, centrifugal, "
          "friction, fixed, handles, tractions, groups, repeat, include)");
  REQUIRE(world_error("  @\"colour\": 1") ==
          "/colour: unknown key (allowed: version, time_step, duration, gravity, bodies, "
          "obstacles, joints, contact, output, initial_state, include, defaults)");
  REQUIRE_THAT(body_error("@\"weather\": true"),
               Catch::StartsWith("/bodies/0/weather: unknown key ("));
  REQUIRE(minimal("\"archive\"", "@\"archiv\"") ==
          "/bodies/0/archiv: unknown key; did you mean \"archive\"?");
  REQUIRE_THAT(minimal("\"time_step\"", "@\"timestep\""),
               Catch::StartsWith("/timestep: unknown key; did you mean \"time_step\"?"));
}

TEST_CASE("what is required must be there") {
  REQUIRE(error_at_mark("@{}") == "the required key \"version\" is missing");
  REQUIRE(error_at_mark("@[]") == "expected a scene (an object), found an empty array");
  REQUIRE(error_at_mark('@' + changed(scene_with(""), "\"duration\": 1, ", "")) ==
          "the required key \"duration\" is missing");
  REQUIRE(error_at_mark("@{\"version\": 1, \"time_step\": 1, \"duration\": 1}") ==
          "the required key \"bodies\" is missing");
  REQUIRE(minimal("{\"name\": \"a\", ", "@{") == "/bodies/0: the required key \"name\" is missing");
  REQUIRE(minimal("[{\"name\": \"a\", \"archive\": \"a.bem\"}", "@[") ==
          "/bodies: expected an array of bodies with at least 1 element, found an "
          "empty array");
}

TEST_CASE("the numbers of a scene are in range") {
  REQUIRE(minimal("\"version\": 1", "\"version\": @2") ==
          "/version: expected the version number 1, found the number 2");
  REQUIRE(minimal("\"version\": 1", "\"version\": @\"1\"") ==
          "/version: expected the version number 1, found the string \"1\"");
  REQUIRE(minimal("0.01", "@0") == "/time_step: expected a time > 0, found the number 0");
  REQUIRE(minimal("0.01", "@1e400") ==
          "/time_step: expected a number within +-1.8e308, found a larger one");
  REQUIRE(minimal("\"duration\": 1", "\"duration\": @-1") ==
          "/duration: expected a time >= 0, found the number -1");
  REQUIRE(minimal("\"duration\": 1", "\"duration\": @1e300") ==
          "/duration: expected at most 2147483647 time steps, found a duration of "
          "more");
  REQUIRE(minimal("\"duration\": 1", "\"duration\": 0") == "");
  REQUIRE(world_error("\"gravity\": @[0, 1]") ==
          "/gravity: expected an array of three numbers, found an array of length 2");
  REQUIRE(world_error("\"gravity\": [0, 1, @true]") ==
          "/gravity/2: expected an acceleration, found true");
}

TEST_CASE("names are unique and fit for files") {
  const auto named = [](const std::string& name) { return minimal("\"a\"", '"' + name + '"'); };
  const auto misnamed = [](const std::string& name) {
    return minimal("\"a\"", "@\"" + name + '"');
  };
  const std::string rule =
      "expected a name that can be used for files (1 to 200 bytes, no \"/\", no control "
      "characters, neither \".\" nor \"..\"), found the string ";
  REQUIRE(named("a b.c \xC3\xA9") == "");
  REQUIRE(named(std::string(200, 'n')) == "");
  REQUIRE(misnamed("") == "/bodies/0/name: " + rule + "\"\"");
  REQUIRE(misnamed(".") == "/bodies/0/name: " + rule + "\".\"");
  REQUIRE(misnamed("..") == "/bodies/0/name: " + rule + "\"..\"");
  REQUIRE(misnamed("a/b") == "/bodies/0/name: " + rule + "\"a/b\"");
  REQUIRE(misnamed("a\\u0000") == "/bodies/0/name: " + rule + "\"a\\x00\"");
  REQUIRE_THAT(misnamed(std::string(201, 'n')), Catch::Contains(rule));

  REQUIRE(minimal("}]", "},\n{\"archive\": \"x\", \"name\": @\"a\"}]") ==
          "/bodies/1/name: the name \"a\" is already used at /bodies/0/name");
  const std::string plane = "\"plane\": {\"point\": [0,0,0], \"normal\": [0,1,0]}";
  REQUIRE(world_error("\"obstacles\": [{\"name\": @\"a\", " + plane + "}]") ==
          "/obstacles/0/name: the name \"a\" is already used at /bodies/0/name");
  REQUIRE(world_error("\"obstacles\": [{\"name\": \"b\", " + plane + "}, {\"name\": @\"b\", " +
                      plane + "}]") ==
          "/obstacles/1/name: the name \"b\" is already used at /obstacles/0/name");
}

TEST_CASE("the members of a body have their types and ranges") {
  REQUIRE(minimal("\"a.bem\"", "@\"\"") ==
          "/bodies/0/archive: expected a path, found the string \"\"");
  REQUIRE(minimal("\"a.bem\"", "@\"a\\u0000b\"") ==
          "/bodies/0/archive: expected a path, found the string \"a\\x00b\"");
  REQUIRE(body_error("\"frame\": @\"statik\"") ==
          "/bodies/0/frame: expected one of the strings moving, static, found \"statik\"; did "
          "you mean \"static\"?");
  REQUIRE(body_error("\"gravity\": @1") ==
          "/bodies/0/gravity: expected true or false, found the number 1");
  REQUIRE(body_error("\"friction\": @-0.5") ==
          "/bodies/0/friction: expected a number >= 0, found the number -0.5");
  REQUIRE(body_error("\"rotation\": {\"axis\": @[0,0,0], \"angle_deg\": 3}") ==
          "/bodies/0/rotation/axis: expected a direction, found the zero vector");
  REQUIRE(body_error("\"rotation\": {\"axis\": [0,0,1], @\"angle\": 3}") ==
          "/bodies/0/rotation/angle: unknown key; did you mean \"angle_deg\"?");
  REQUIRE(body_error("\"rotation\": @[0,0,1]") ==
          "/bodies/0/rotation: expected a rotation (an object), found an array of length 3");
  REQUIRE(body_error("\"position\": @null") ==
          "/bodies/0/position: expected an array of three numbers, found null");
  REQUIRE(body_error("\"velocity\": @\"fast\"") ==
          "/bodies/0/velocity: expected an array of three numbers, found the string \"fast\"");
  REQUIRE(body_error("\"angular_velocity\": @[1]") ==
          "/bodies/0/angular_velocity: expected an array of three numbers, found an array of "
          "length 1");
}

TEST_CASE("selections have one of their forms") {
  const auto fixed = [](const std::string& selection) {
    return body_error("\"fixed\": [" + selection + "]");
  };
  const std::string box = "{\"min\": [0,0,0], \"max\": [1,1,1]}";
  REQUIRE(fixed("\"all\"") == "");
  REQUIRE(fixed("{\"box\": " + box + ", \"normal\": [0,0,1], \"normal_tolerance_deg\": 0}") == "");
  REQUIRE(
      fixed("@\"every\"") ==
      "/bodies/0/fixed/0: expected a selection (\"all\" or an object), found the string \"every\"");
  REQUIRE(fixed("@7") ==
          "/bodies/0/fixed/0: expected a selection (\"all\" or an object), found the number 7");
  REQUIRE(fixed("@{}") ==
          "/bodies/0/fixed/0: one of the keys vertices, triangles, box, sphere, plane, group is "
          "required");
  REQUIRE(fixed("{@\"vertexes\": [1]}") ==
          "/bodies/0/fixed/0/vertexes: unknown key; did you mean \"vertices\"?");
  REQUIRE(fixed("{\"vertices\": [1], @\"triangles\": [1]}") ==
          "/bodies/0/fixed/0/triangles: \"triangles\" is not allowed beside \"vertices\"");
  REQUIRE(fixed("{\"vertices\": @[]}") ==
          "/bodies/0/fixed/0/vertices: expected an array of vertex indices with at least 1 "
          "element, found an empty array");
  REQUIRE(fixed("{\"vertices\": [0, @-1]}") ==
          "/bodies/0/fixed/0/vertices/1: expected an integer from 0 to 2147483647, found the "
          "number -1");
  REQUIRE(fixed("{\"triangles\": [@0.5]}") ==
          "/bodies/0/fixed/0/triangles/0: expected an integer from 0 to 2147483647, found the "
          "number 0.5");
  REQUIRE(fixed("{\"triangles\": [@2147483648]}") ==
          "/bodies/0/fixed/0/triangles/0: expected an integer from 0 to 2147483647, found the "
          "number 2147483648");
  REQUIRE(fixed("{\"triangles\": @1}") ==
          "/bodies/0/fixed/0/triangles: expected an array of triangle indices, found the "
          "number 1");
  REQUIRE(fixed("{\"box\": {\"min\": [0,2,0], \"max\": @[1,1,1]}}") ==
          "/bodies/0/fixed/0/box/max: expected \"max\" >= \"min\", found a smaller y");
  REQUIRE(fixed("{\"box\": @{\"min\": [0,2,0]}}") ==
          "/bodies/0/fixed/0/box: the required key \"max\" is missing");
  REQUIRE(fixed("{\"vertices\": [1], @\"normal\": [0,0,1]}") ==
          "/bodies/0/fixed/0/normal: \"normal\" is allowed only beside \"box\", \"sphere\" or "
          "\"plane\"");
  REQUIRE(fixed("{\"box\": " + box + ", @\"normal_tolerance_deg\": 5}") ==
          "/bodies/0/fixed/0/normal_tolerance_deg: \"normal_tolerance_deg\" is allowed only "
          "beside \"normal\"");
  REQUIRE(fixed("{\"box\": " + box + ", \"normal\": [0,0,1], \"normal_tolerance_deg\": @181}") ==
          "/bodies/0/fixed/0/normal_tolerance_deg: expected an angle from 0 to 180 degrees, found "
          "the number 181");
}

TEST_CASE("handles and their keyframes are checked") {
  const auto handle = [](const std::string& members) {
    return body_error("\"handles\": [{" + members + "}]");
  };
  const std::string select = "\"select\": \"all\", ";
  REQUIRE(body_error("\"handles\": [@{\"motion\": []}]") ==
          "/bodies/0/handles/0: the required key \"select\" is missing");
  REQUIRE(handle(select + "\"release_time\": @-1") ==
          "/bodies/0/handles/0/release_time: expected a time >= 0, found the number -1");
  REQUIRE(handle(select + "\"motion\": [@{}]") ==
          "/bodies/0/handles/0/motion/0: the required key \"time\" is missing");
  REQUIRE(handle(select + "\"motion\": [{\"time\": 1}, {\"time\": @1}]") ==
          "/bodies/0/handles/0/motion/1/time: expected a later time than in the element "
          "before, found the number 1");
  REQUIRE(handle(select + "\"motion\": [{\"time\": 1, @\"rotat\": 1}]") ==
          "/bodies/0/handles/0/motion/0/rotat: unknown key; did you mean \"rotate\"? "
          "(allowed: time, translate, rotate, about)");
  REQUIRE(handle(select + "@\"release\": 1") ==
          "/bodies/0/handles/0/release: unknown key; did you mean \"release_time\"? (allowed: "
          "select, motion, release_time)");
}

TEST_CASE("tractions and their profiles are checked") {
  const auto traction = [](const std::string& members) {
    return body_error("\"tractions\": [{\"select\": \"all\"" + members + "}]");
  };
  REQUIRE(body_error("\"tractions\": [@{\"select\": \"all\"}]") ==
          "/bodies/0/tractions/0: one of the keys traction, pressure is required");
  REQUIRE(traction(", @\"pressure\": 1, \"traction\": [1,0,0]") ==
          "/bodies/0/tractions/0/pressure: \"pressure\" is not allowed beside \"traction\"");
  REQUIRE(traction(", @\"presure\": 1") ==
          "/bodies/0/tractions/0/presure: unknown key; did you mean \"pressure\"?");
  REQUIRE(traction(", \"pressure\": @[1,0,0]") ==
          "/bodies/0/tractions/0/pressure: expected a pressure, found an array of length 3");
  REQUIRE(traction(", \"traction\": @1") ==
          "/bodies/0/tractions/0/traction: expected an array of three numbers, found the "
          "number 1");
  REQUIRE(traction(", \"pressure\": 1, \"follow\": @false") ==
          "/bodies/0/tractions/0/follow: expected true, because a pressure turns with the "
          "body, found false");
  const std::string load = ", \"pressure\": 1, \"profile\": ";
  REQUIRE(traction(load + "@[]") ==
          "/bodies/0/tractions/0/profile: expected an array of [time, factor] pairs with at "
          "least 1 element, found an empty array");
  REQUIRE(traction(load + "[[0,1],[@0,2]]") ==
          "/bodies/0/tractions/0/profile/1/0: expected a later time than in the element "
          "before, found the number 0");
  REQUIRE(traction(load + "[@[0,1,2]]") ==
          "/bodies/0/tractions/0/profile/0: expected a pair [time, factor], found an array of "
          "length 3");
  REQUIRE(traction(load + "[@0, 1]") ==
          "/bodies/0/tractions/0/profile/0: expected an array [time, factor], found the number "
          "0");
  REQUIRE(traction(load + "[[0, @null]]") ==
          "/bodies/0/tractions/0/profile/0/1: expected a number, found null");
}

TEST_CASE("obstacles are planes or meshes") {
  const auto obstacle = [](const std::string& members) {
    return world_error("\"obstacles\": [{\"name\": \"o\"" + members + "}]");
  };
  const std::string plane = ", \"plane\": {\"point\": [0,0,0], \"normal\": [0,1,0]}";
  REQUIRE(obstacle(plane) == "");
  REQUIRE(world_error("\"obstacles\": [@{\"name\": \"o\"}]") ==
          "/obstacles/0: one of the keys plane, mesh is required");
  REQUIRE(obstacle(plane + ", @\"mesh\": \"m.obj\"") ==
          "/obstacles/0/mesh: \"mesh\" is not allowed beside \"plane\"");
  REQUIRE(obstacle(plane + ", @\"motion\": []") ==
          "/obstacles/0/motion: \"motion\" is allowed only beside \"mesh\"");
  REQUIRE(obstacle(plane + ", \"friction\": @-1") ==
          "/obstacles/0/friction: expected a number >= 0, found the number -1");
  REQUIRE(obstacle(", \"plane\": {\"point\": [0,0,0], \"normal\": @[0,0,0]}") ==
          "/obstacles/0/plane/normal: expected a direction, found the zero vector");
}

TEST_CASE("joints name two bodies of the scene") {
  const auto joint = [](const std::string& members) {
    return error_at_mark(
        "{\"version\": 1, \"time_step\": 1, \"duration\": 1, \"bodies\": ["
        "{\"name\": \"left\", \"archive\": \"a\"},"
        "{\"name\": \"right\", \"archive\": \"a\"}],\n\"joints\": [" +
        members + "]}");
  };
  const std::string weld = "{\"type\": \"weld\", \"a\": {\"body\": \"left\"}, ";
  REQUIRE(joint(weld + "\"b\": {\"body\": \"right\"}}") == "");
  REQUIRE(joint(weld + "\"b\": {\"body\": @\"rigth\"}}") ==
          "/joints/0/b/body: expected the name of a body of this scene, found "
          "\"rigth\"; did you mean \"right\"?");
  REQUIRE(joint(weld + "\"b\": {\"body\": @\"left\"}}") ==
          "/joints/0/b/body: expected another body than at the side \"a\" of the "
          "joint");
  REQUIRE(joint(weld + "\"b\": {\"body\": \"right\", @\"point\": [0,0,0]}}") ==
          "/joints/0/b/point: \"point\" is allowed only in joints of type \"point\"");
  REQUIRE(joint(weld + "\"b\": {\"body\": \"right\"}, \"tolerance\": @0}") ==
          "/joints/0/tolerance: expected a length > 0, found the number 0");
  REQUIRE(joint("{\"type\": @\"glue\"}") ==
          "/joints/0/type: expected one of the strings point, weld, found \"glue\"");
  REQUIRE(joint("{\"type\": \"point\", \"a\": @{\"body\": \"left\"}}") ==
          "/joints/0/a: the required key \"point\" is missing");
  REQUIRE(joint("@{\"type\": \"weld\", \"a\": {\"body\": \"left\"}}") ==
          "/joints/0: the required key \"b\" is missing");
}

TEST_CASE("contact and output settings are checked") {
  REQUIRE(world_error("\"contact\": {\"tolerance\": @0}") ==
          "/contact/tolerance: expected a length > 0, found the number 0");
  REQUIRE(world_error("\"contact\": {\"enabled\": @\"yes\"}") ==
          "/contact/enabled: expected true or false, found the string \"yes\"");
  REQUIRE(world_error("\"contact\": {\"friction_combine\": @\"mean\"}") ==
          "/contact/friction_combine: expected one of the strings max, min, average, multiply, "
          "found \"mean\"");
  REQUIRE(world_error("\"contact\": @true") ==
          "/contact: expected the contact settings (an object), found true");
  REQUIRE(world_error("\"output\": {\"formats\": [@\"hdf\"]}") ==
          "/output/formats/0: expected one of the strings obj, hdf5, vtp, pc2, usda, glb, found "
          "\"hdf\"; "
          "did you mean \"hdf5\"?");
  REQUIRE(world_error("\"output\": {\"formats\": @[]}") ==
          "/output/formats: expected an array of formats with at least 1 element, found an "
          "empty array");
  REQUIRE(world_error("\"output\": {\"formats\": [\"obj\", @\"obj\"]}") ==
          "/output/formats/1: the string \"obj\" is already in this array");
  REQUIRE(world_error("\"output\": {\"every\": @0}") ==
          "/output/every: expected an integer from 1 to 2147483647, found the number 0");
  REQUIRE(world_error("\"output\": {\"fields\": [@\"traction\"]}") ==
          "/output/fields/0: expected one of the strings positions, velocities, tractions, stress, "
          "contacts, found "
          "\"traction\"; did you mean \"tractions\"?");
}

TEST_CASE("a body without loads is one on which nothing of the scene acts") {
  const auto error = [](const std::string& loads, const std::string& members,
                        const std::string& world) {
    return error_at_mark(
        "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1,\n\"bodies\": [\n{\"name\": \"a\", "
        "\"mesh\": \"a.obj\", \"material\": \"rubber\",\n\"precompute\": {" +
        loads + "}" + members + "}]" + world + "}");
  };
  const auto refused = [](const std::string& acting) {
    return "/bodies/0/precompute/loads: a body without loads cannot be held or touched, but \"" +
           acting + "\" of the scene may act on it; leave \"loads\" away";
  };
  const std::string none = "\"loads\": @\"none\"", pull = ", \"tractions\": []";
  const std::string joint =
      ", \"joints\": [{\"type\": \"point\", \"a\": {\"body\": \"a\", \"point\": [0, 0, 0]}}]";
  CHECK(error(none, ", \"fixed\": [\"all\"]", "") == refused("fixed"));
  CHECK(error(none, ", \"handles\": [{\"select\": \"all\"}]", "") == refused("handles"));
  CHECK(error(none, pull, joint) == refused("joints"));
  CHECK(error(none, pull, ", \"contact\": {}") == refused("contact"));
  CHECK(error("\"loads\": \"none\"", pull, "") == "");
  CHECK(error("\"loads\": \"all\"", "", ", \"contact\": {}") == "");
  CHECK(error("\"loads\": \"none\", \"model\": \"rigid\"", "", ", \"contact\": {}") == "");
}

TEST_CASE("a material in a scene has no time step") {
  const std::string text = scene_with_body(
      ", \"material\": {\"name\": \"m\", @\"time_step\": 1, \"density\": 1000, \"shear_modulus\": "
      "1e5, \"poisson_ratio\": 0.3}, \"mesh\": \"a.obj\"");
  CHECK(error_at_mark(text) ==
        "/bodies/0/material/time_step: \"time_step\" is no key of a material in a scene, which has "
        "a \"time_step\" itself");
}

TEST_CASE("a misspelt key of a place is answered with the valid one") {
  CHECK(body_error("\"place\": {@\"centre\": [0, 0, 0]}") ==
        "/bodies/0/place/centre: unknown key; did you mean \"center\"?");
}
