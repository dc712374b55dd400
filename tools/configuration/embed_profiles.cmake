# cmake -DOUTPUT=FILE -DCONFIG_DIR=FOLDER -P embed_profiles.cmake
# Writes every profile of the folder into a C++ source, named by its file name.
file(GLOB profiles ${CONFIG_DIR}/*.toml)
set(source "#include \"tools/configuration/embedded_profiles.h\"\n\nnamespace sparsight {\n\n")
string(APPEND source "std::span<const EmbeddedProfile> embedded_profiles() {\n")
string(APPEND source "  static constexpr EmbeddedProfile kProfiles[] = {\n")
foreach(profile ${profiles})
  get_filename_component(name ${profile} NAME_WE)
  file(READ ${profile} toml)
  string(APPEND source "      {\"${name}\", R\"toml(${toml})toml\"},\n")
endforeach()
string(APPEND source "  };\n  return kProfiles;\n}\n\n}  // namespace sparsight\n")
file(WRITE ${OUTPUT} "${source}")
