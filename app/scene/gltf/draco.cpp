/* SPDX-License-Identifier: MIT */
/* draco.cpp - meshes that Draco compressed, in C++ because the library has no other interface. No
 * exception leaves it. */
#include "app/scene/gltf/draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <memory>

struct draco_mesh {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

/* Limits on faces and points, far above those of real meshes, so that a few bytes cannot claim much
 * memory. */
constexpr uint64_t FACES_A_BYTE = 256, FACES_BESIDES = 100000;

/* Whether the header's numbers of faces and points, by which the decoder allocates, are
 * plausible. */
bool is_plausible(draco::DecoderBuffer buffer, size_t size) {
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH || header.version_major != 2 ||
        header.version_minor != 2)
        return false;
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    draco::GeometryMetadata metadata;
    if ((header.flags & METADATA_FLAG_MASK) &&
        !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
        return false;
    uint8_t traversal;
    uint32_t first, second; /* faces and points, or vertices and faces */
    return (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING ||
            buffer.Decode(&traversal)) &&
           draco::DecodeVarint(&first, &buffer) && draco::DecodeVarint(&second, &buffer) &&
           first <= FACES_A_BYTE * size + FACES_BESIDES &&
           second <= FACES_A_BYTE * size + FACES_BESIDES;
}

template <typename T>
bool fill(const draco::Mesh &mesh, const draco::PointAttribute &attribute, int width,
          void *numbers) {
    T *to = static_cast<T *>(numbers);
    for (uint32_t i = 0; i < mesh.num_points(); i++, to += width) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(value, static_cast<int8_t>(width), to))
            return false;
    }
    return true;
}

} // namespace

draco_mesh *draco_mesh_decode(const void *data, size_t size) {
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(static_cast<const char *>(data), size);
        if (!is_plausible(buffer, size))
            return nullptr;
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        return decoded.ok() ? new draco_mesh { std::move(decoded).value() } : nullptr;
    } catch (...) {
        return nullptr;
    }
}

void draco_mesh_free(draco_mesh *mesh) {
    delete mesh;
}

size_t draco_mesh_vertices(const draco_mesh *mesh) {
    return mesh->mesh->num_points();
}

size_t draco_mesh_triangles(const draco_mesh *mesh) {
    return mesh->mesh->num_faces();
}

bool draco_mesh_corners(const draco_mesh *mesh, uint32_t *corners) {
    for (uint32_t i = 0; i < mesh->mesh->num_faces(); i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = mesh->mesh->face(draco::FaceIndex(i))[k].value();
            if (corner >= mesh->mesh->num_points())
                return false;
            *corners++ = corner;
        }
    return true;
}

bool draco_mesh_attribute(const draco_mesh *mesh, uint32_t id, int width, int component,
                          void *numbers) {
    const draco::PointAttribute *const attribute = mesh->mesh->GetAttributeByUniqueId(id);
    if (!attribute || attribute->num_components() != width)
        return false;
    switch (component) {
    case 5120:
        return fill<int8_t>(*mesh->mesh, *attribute, width, numbers);
    case 5121:
        return fill<uint8_t>(*mesh->mesh, *attribute, width, numbers);
    case 5122:
        return fill<int16_t>(*mesh->mesh, *attribute, width, numbers);
    case 5123:
        return fill<uint16_t>(*mesh->mesh, *attribute, width, numbers);
    case 5125:
        return fill<uint32_t>(*mesh->mesh, *attribute, width, numbers);
    case 5126:
        return fill<float>(*mesh->mesh, *attribute, width, numbers);
    default:
        return false;
    }
}
