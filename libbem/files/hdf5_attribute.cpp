#include "files/hdf5.hpp"
#include "files/hdf5_handle.hpp"

// The part of Hdf5File that deals with attributes.

namespace bem {
namespace {

Hdf5Handle open_object(hid_t file, const std::string& path) {
  return {H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose};
}

Hdf5Handle open_attribute(hid_t file, const std::string& object, const std::string& name) {
  return {H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
}

/// Text of variable length, which h5py hands out as str; text of fixed length would be bytes.
Hdf5Handle text_type(H5T_cset_t characters) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), characters);
  return type;
}

/// Creates or replaces a scalar attribute; false if the library failed.
bool write_attribute(hid_t object, const std::string& name, hid_t stored, hid_t memory,
                     const void* value) {
  if (H5Aexists(object, name.c_str()) > 0 && H5Adelete(object, name.c_str()) < 0) return false;
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), stored, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute.get(), memory, value) >= 0;
}

bool is_scalar(const Hdf5Handle& attribute) {
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  return H5Sget_simple_extent_npoints(space.get()) == 1;
}

std::string read_fixed_text(const Hdf5Handle& attribute, const Hdf5Handle& stored, bool& good) {
  std::string text(H5Tget_size(stored.get()), '\0');
  good = H5Aread(attribute.get(), stored.get(), text.data()) >= 0;
  return text.substr(0, text.find('\0'));
}

std::string read_variable_text(const Hdf5Handle& attribute, const Hdf5Handle& stored, bool& good) {
  const Hdf5Handle memory = text_type(H5Tget_cset(stored.get()));
  char* text = nullptr;
  good = H5Aread(attribute.get(), memory.get(), &text) >= 0;
  const std::string result = good && text ? text : "";
  if (text) H5free_memory(text);
  return result;
}

std::string quoted(const std::string& name) {
  return "attribute \"" + name + "\"";
}

}  // namespace

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& value) {
  require(value.find('\0') == std::string::npos, "a text attribute has no zero byte");
  const Hdf5Handle owner = open_object(id(), object);
  if (!owner) fail(object, "no such object");
  const Hdf5Handle type = text_type(H5T_CSET_UTF8);
  const char* text = value.c_str();
  if (!write_attribute(owner.get(), name, type.get(), type.get(), &text))
    fail_in_library(object, quoted(name) + " cannot be written");
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const char* value) {
  set_attribute(object, name, std::string(value));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const Hdf5Handle owner = open_object(id(), object);
  if (!owner) fail(object, "no such object");
  if (!write_attribute(owner.get(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value))
    fail_in_library(object, quoted(name) + " cannot be written");
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::int64_t value) {
  const Hdf5Handle owner = open_object(id(), object);
  if (!owner) fail(object, "no such object");
  if (!write_attribute(owner.get(), name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value))
    fail_in_library(object, quoted(name) + " cannot be written");
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::string_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(id(), object, name);
  if (!attribute) fail(object, "no " + quoted(name));
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tget_class(stored.get()) != H5T_STRING || !is_scalar(attribute))
    fail(object, quoted(name) + " is not a text");
  bool good = false;
  std::string text = H5Tis_variable_str(stored.get()) > 0
                         ? read_variable_text(attribute, stored, good)
                         : read_fixed_text(attribute, stored, good);
  if (!good) fail(object, quoted(name) + " cannot be read");
  return text;
}

double Hdf5File::double_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(id(), object, name);
  if (!attribute) fail(object, "no " + quoted(name));
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(stored.get());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || !is_scalar(attribute))
    fail(object, quoted(name) + " is not a number");
  double value = 0;
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail_in_library(object, quoted(name) + " cannot be read");
  return value;
}

std::int64_t Hdf5File::int_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(id(), object, name);
  if (!attribute) fail(object, "no " + quoted(name));
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tget_class(stored.get()) != H5T_INTEGER || !is_scalar(attribute))
    fail(object, quoted(name) + " is not an integer");
  std::int64_t value = 0;
  if (H5Aread(attribute.get(), H5T_NATIVE_INT64, &value) < 0)
    fail_in_library(object, quoted(name) + " cannot be read");
  return value;
}

}  // namespace bem
