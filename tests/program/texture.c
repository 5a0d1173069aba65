/* SPDX-License-Identifier: MIT */
/* An image is stored once, under however many names, images, samplers and materials a scene uses
 * it; its format must be a documented one. */
#include "app/scene/texture.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <webp/encode.h>

/* A PNG of one white pixel. */
static const unsigned char pixel_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0x0f, 0x04, 0x00, 0x09, 0xfb, 0x03, 0xfd, 0xfb, 0x5e, 0x6b, 0x2b,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82
};

/* The scene has base colors by three images of one file and four samplers, two of them alike, and
 * one of the images as metallic and roughness, which is another color space. */
static void a_gltf_stores_an_image_once(void **state) {
    (void)state;
    folder_write_text(
        "scene.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"a.png\"},{\"uri\":\"./a.png\"}],"
        "\"samplers\":[{},{\"wrapS\":33071},{\"wrapS\":10497},{\"wrapT\":33648}],"
        "\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":1,\"sampler\":1},"
        "{\"source\":2,\"sampler\":2},{\"source\":0,\"sampler\":3},{\"source\":2}],"
        "\"materials\":["
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
        "\"metallicRoughnessTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":3}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":4}}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    scene world = load(in_folder("scene.gltf"));
    assert_int_equal(world.texel_bytes, 4);
    assert_int_equal(world.texture_count, 4); /* repeat, clamp, mirror; repeat as linear */
    static const int expected[] = { 0, 2, 0, 3, 0 };
    for (int i = 0; i < 5; i++)
        assert_int_equal(world.materials[i].base_color_map.texture, expected[i]);
    assert_int_equal(world.materials[0].metallic_roughness_map.texture, 1);
    scene_free(&world);
}

static void an_obj_stores_an_image_once(void **state) {
    (void)state;
    folder_write_text("scene.obj", "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                   "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n"
                                   "usemtl c\nf 1/1 2/1 3/1\n");
    folder_write_text("scene.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd -clamp on a.png\n"
                                   "newmtl c\nmap_Kd ./A.PNG\n");
    scene world = load(in_folder("scene.obj"));
    assert_int_equal(world.texel_bytes, 4);
    assert_int_equal(world.texture_count, 2);
    scene_free(&world);
}

/* The image that EXT_texture_webp names replaces the plain one. An image that only
 * KHR_texture_basisu names is unsupported, and reported, even where the file requires it. */
static void a_webp_of_a_gltf_is_its_base_color(void **state) {
    (void)state;
    static const unsigned char color[4] = { 10, 20, 30, 255 };
    unsigned char *webp;
    const size_t size = WebPEncodeLosslessRGBA(color, 1, 1, 4, &webp);
    folder_write("b.webp", webp, size);
    WebPFree(webp);
    folder_write_text(
        "webp.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"extensionsUsed\":[\"EXT_texture_webp\",\"KHR_texture_basisu\"],"
        "\"extensionsRequired\":[\"EXT_texture_webp\",\"KHR_texture_basisu\"],"
        "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"b.webp\",\"mimeType\":\"image/webp\"}],"
        "\"textures\":[{\"source\":0,\"extensions\":{\"EXT_texture_webp\":{\"source\":1}}},"
        "{\"source\":0,\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}},"
        "{\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}}],"
        "\"materials\":["
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    scene world = load(in_folder("webp.gltf"));
    assert_int_equal(world.texture_count, 2);
    assert_memory_equal(world.texels + world.textures[0].first_byte, color, 4);
    assert_memory_equal(world.texels + world.textures[1].first_byte, "\xff\xff\xff\xff", 4);
    static const int expected[] = { 0, 1, -1 };
    for (int i = 0; i < 3; i++)
        assert_int_equal(world.materials[i].base_color_map.texture, expected[i]);
    assert_in_range(world.unsupported_count, 1, 2); /* also the triangle's lack of coordinates */
    assert_string_equal(world.unsupported[0].what, "KHR_texture_basisu");
    scene_free(&world);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return 1;
    folder_write("a.png", pixel_png, sizeof pixel_png);
    return 0;
}

/* The decoder could read them all: each file has one pixel. */
static void formats_that_no_page_names_are_refused(void **state) {
    (void)state;
    static const char gif[] =
        "GIF87a\1\0\1\0\200\0\0\377\377\377\377\377\377,\0\0\0\0\1\0\1\0\0\2\2D"
        "\1\0;";
    static const char pnm[] = "P6\n1 1\n255\nabc";
    static const char psd[] = "8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\1\0\0\0\1\0\10\0\3\0\0\0\0\0\0\0\0"
                              "\0\0\0\0\0\0abc";
    static const char hdr[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd";
    static const struct {
        const char *bytes;
        size_t size;
    } images[] = { { gif, sizeof gif - 1 },
                   { pnm, sizeof pnm - 1 },
                   { psd, sizeof psd - 1 },
                   { hdr, sizeof hdr - 1 } };
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        scene_builder builder = { .out_of_memory = false };
        scene_texture texture;
        base_error error;
        assert_false(texture_keep(&builder, images[i].bytes, images[i].size, TEXTURE_ANY, "scene",
                                  "image", &texture, &error));
        assert_string_equal(
            error.text, "scene: has a texture \"image\" that is not a PNG, JPEG, WebP, TGA or BMP");
        assert_int_equal(builder_count(&builder, BLOB_IMAGES), 0);
        builder_free(&builder);
    }
}

/* A file of some bytes claims 10000 x 10000 pixels: the decoder would invent them, and the cache
 * would keep 400 MB. The same file with as many pixels as it has is read. */
static void few_bytes_are_not_many_pixels(void **state) {
    (void)state;
    unsigned char bmp[64] = "BM\x40\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18";
    unsigned char tga[32] = "\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18";
    /* gray, its tables of one code each */
    unsigned char jpeg[144] = "\xff\xd8\xff\xdb\0\x43";
    memset(jpeg + 7, 1, 64);
    memcpy(jpeg + 71, "\xff\xc0\0\13\10\0\1\0\1\1\1\x11\0", 13);
    memcpy(jpeg + 84, "\xff\xc4\0\24\0\1", 6);
    memcpy(jpeg + 106, "\xff\xc4\0\24\x10\1", 6);
    memcpy(jpeg + 128, "\xff\xda\0\10\1\1\0\0\x3f", 9);
    memcpy(jpeg + sizeof jpeg - 2, "\xff\xd9", 2);
    const struct {
        unsigned char *bytes;
        size_t size, width, height; /* offsets of these in the file */
        bool big_endian;
    } images[] = { { bmp, sizeof bmp, 18, 22, false },
                   { tga, sizeof tga, 12, 14, false },
                   { jpeg, sizeof jpeg, 78, 76, true } };
    for (size_t i = 0; i < sizeof images / sizeof *images; i++)
        for (int large = 0; large < 2; large++) {
            scene_builder builder = { .out_of_memory = false };
            scene_texture texture;
            base_error error = { "" };
            if (large)
                for (int k = 0; k < 2; k++) /* 10000 is 0x2710 */
                    memcpy(images[i].bytes + (k ? images[i].width : images[i].height),
                           images[i].big_endian ? "\x27\x10" : "\x10\x27", 2);
            const bool read = texture_keep(&builder, images[i].bytes, images[i].size, TEXTURE_ANY,
                                           "scene", "image", &texture, &error) &&
                              texture_decode_all(&builder, "scene", &error);
            if (read == (large == 1))
                fail_msg("image %zu: \"%s\"", i, error.text);
            assert_true(!large || strstr(error.text, "of 10000 x 10000 pixels in "));
            assert_int_equal(builder_count(&builder, BLOB_TEXELS), large ? 0 : 4);
            builder_free(&builder);
        }
}

/* --- a scene of many images ------------------------------------------------------------------- */

enum { IMAGES = 40, SIDE_MAX = IMAGES + 2 };

/* Writes a gray TGA of (number + 3) x 3 pixels; its last `missing` bytes are cut off. */
static void write_gray(int number, size_t missing) {
    unsigned char bytes[18 + 3 * 3 * SIDE_MAX] = "\0\0\2\0\0\0\0\0\0\0\0\0\0\0\3\0\x18";
    char name[32];
    bytes[12] = (unsigned char)(number + 3);
    memset(bytes + 18, 5 * number, sizeof bytes - 18);
    snprintf(name, sizeof name, "gray%d.tga", number);
    folder_write(name, bytes, 18 + 9 * (size_t)(number + 3) - missing);
}

static void write_grays(void) {
    char obj[IMAGES * 64] = "mtllib grays.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
    char mtl[IMAGES * 64] = "";
    size_t at = strlen(obj), used = 0;
    for (int i = 0; i < IMAGES; i++) {
        write_gray(i, 0);
        at += (size_t)snprintf(obj + at, sizeof obj - at, "usemtl m%d\nf 1/1 2/1 3/1\n", i);
        used += (size_t)snprintf(mtl + used, sizeof mtl - used, "newmtl m%d\nmap_Kd gray%d.tga\n",
                                 i, i);
    }
    folder_write_text("grays.obj", obj);
    folder_write_text("grays.mtl", mtl);
}

static void images_are_decoded_side_by_side(void **state) {
    (void)state;
    write_grays();
    scene world = load(in_folder("grays.obj"));
    assert_int_equal(world.image_count, IMAGES);
    assert_int_equal(world.texture_count, IMAGES);
    for (int i = 0; i < IMAGES; i++) {
        const scene_texture *texture = &world.textures[i];
        const int number = (int)texture->width - 3;
        assert_int_equal(texture->height, 3);
        for (size_t k = 0; k < 4 * 3 * (size_t)texture->width; k++)
            assert_int_equal(world.texels[texture->first_byte + k], k % 4 == 3 ? 255 : 5 * number);
    }
    scene_free(&world);
}

/* The scene keeps the files' bytes, not the texels. */
static void images_stay_as_their_files_have_them(void **state) {
    (void)state;
    scene world;
    base_error error;
    write_grays();
    assert_true(scene_load(in_folder("grays.obj"),
                           &(scene_options) { .no_cache = true, .no_texels = true }, &world,
                           &error));
    assert_null(world.texels);
    size_t files = 0;
    for (int i = 0; i < IMAGES; i++)
        files += 18 + 9 * (size_t)(i + 3);
    assert_int_equal(world.encoded_bytes, files);
    scene_free(&world);
}

/* A reader that needs no texels does not notice; others are shown the rest of the scene. */
static void an_image_that_cannot_be_decoded_is_unsupported(void **state) {
    (void)state;
    static const unsigned char damaged[] =
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x8\2\0\0\0\x90wS\xde\0\0\0\0IDAT";
    scene_options options = { .no_cache = true, .no_texels = true };
    scene world;
    base_error error = { "" };
    write_grays();
    folder_write("gray7.tga", damaged, sizeof damaged - 1);
    assert_true(scene_load(in_folder("grays.obj"), &options, &world, &error));
    assert_int_equal(world.unsupported_count, 0);
    scene_free(&world);
    options.no_texels = false;
    assert_true(scene_load(in_folder("grays.obj"), &options, &world, &error));
    assert_int_equal(world.unsupported_count, 1);
    assert_string_equal(world.unsupported[0].what, "gray7.tga");
    int bare = 0;
    for (size_t i = 0; i < world.material_count; i++) {
        const int32_t texture = world.materials[i].base_color_map.texture;
        bare += texture < 0;
        assert_true((texture < 0) == (strcmp(world.materials[i].name, "m7") == 0 ||
                                      strcmp(world.materials[i].name, "DefaultMaterial") == 0));
    }
    assert_int_equal(bare, 2);
    scene_free(&world);
    options.strict = true;
    assert_false(scene_load(in_folder("grays.obj"), &options, &world, &error));
    assert_non_null(strstr(error.text, "gray7.tga (1 undecodable image)"));
    write_gray(7, 0);
}

/* Paths of another computer, or folders that were not copied: what lies beside the scene under the
 * same name is meant. */
static void an_image_beside_the_scene_is_found_by_its_name(void **state) {
    (void)state;
    static const char *const names[] = { "C:\\art\\a.png", "/home/somebody/a.png", "../maps/a.png",
                                         "maps/a.png", "file:///C:/art/a.png" };
    char text[256];
    folder_write_text("beside.obj", "mtllib beside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                    "usemtl m\nf 1/1 2/1 3/1\n");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(text, sizeof text, "newmtl m\nmap_Kd %s\n", names[i]);
        folder_write_text("beside.mtl", text);
        scene s = load(in_folder("beside.obj"));
        assert_int_equal(s.texture_count, 1);
        assert_int_equal(s.unsupported_count, 0);
        scene_free(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(images_are_decoded_side_by_side),
        cmocka_unit_test(images_stay_as_their_files_have_them),
        cmocka_unit_test(an_image_that_cannot_be_decoded_is_unsupported),
        cmocka_unit_test(a_gltf_stores_an_image_once),
        cmocka_unit_test(an_obj_stores_an_image_once),
        cmocka_unit_test(an_image_beside_the_scene_is_found_by_its_name),
        cmocka_unit_test(a_webp_of_a_gltf_is_its_base_color),
        cmocka_unit_test(formats_that_no_page_names_are_refused),
        cmocka_unit_test(few_bytes_are_not_many_pixels),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
