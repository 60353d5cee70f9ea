# Vulkan-Hpp and the Vulkan headers only: the loader is opened at run time, so that the program starts
# (and the CPU commands work) on a machine without it.
find_path(VulkanHeaders_INCLUDE_DIR vulkan/vulkan_raii.hpp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(VulkanHeaders REQUIRED_VARS VulkanHeaders_INCLUDE_DIR)
if(VulkanHeaders_FOUND AND NOT TARGET VulkanHeaders::VulkanHeaders)
  add_library(VulkanHeaders::VulkanHeaders INTERFACE IMPORTED)
  target_include_directories(VulkanHeaders::VulkanHeaders SYSTEM INTERFACE ${VulkanHeaders_INCLUDE_DIR})
endif()
