/* exr.cpp - OpenEXR behind a C interface: the only C++ of ours outside patches/. */
#include "exr.h"

extern "C" {
#include "exr_header.h"
#include "image.h"
#include "status.h"
}

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfIO.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

/* ---- streams in memory ---- */

class MemoryInput : public Imf::IStream
{
  public:
    MemoryInput(const unsigned char *bytes, size_t size, const char *name)
        : Imf::IStream(name), bytes_(bytes), size_(size), at_(0)
    {
    }
    bool read(char out[], int count) override
    {
        if (count < 0 || size_ - at_ < static_cast<size_t>(count))
            throw std::runtime_error("the file ends too early");
        std::memcpy(out, bytes_ + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < size_;
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t position) override
    {
        if (position > size_)
            throw std::runtime_error("an offset points past the end of the file");
        at_ = position;
    }

  private:
    const unsigned char *bytes_;
    size_t size_, at_;
};

class MemoryOutput : public Imf::OStream
{
  public:
    MemoryOutput() : Imf::OStream("memory"), at_(0) {}
    void write(const char in[], int count) override
    {
        const size_t end = at_ + static_cast<size_t>(count);
        if (end > bytes.size())
            bytes.resize(end);
        std::memcpy(bytes.data() + at_, in, static_cast<size_t>(count));
        at_ = end;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t position) override { at_ = position; }

    std::vector<unsigned char> bytes;

  private:
    size_t at_;
};

/* ---- exceptions to statuses ---- */

/* Runs `body`, which returns a pe_status; what it throws becomes one sentence about `name`. */
template <typename Body> pe_status guarded(const char *name, pe_error *error, Body body)
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return pe_fail(error, PE_ERROR_MEMORY, "%s: not enough memory", name);
    } catch (const std::exception &e) {
        std::string what = e.what();
        for (char &c : what)
            if (c == '\n')
                c = ' ';
        while (!what.empty() && (what.back() == '.' || what.back() == ' '))
            what.pop_back();
        return pe_fail(error, PE_ERROR_FORMAT, "%s: OpenEXR says: %s", name, what.c_str());
    }
}

/* ---- pictures ---- */

long long width_of(const Imath::Box2i &window)
{
    return static_cast<long long>(window.max.x) - window.min.x + 1;
}

long long height_of(const Imath::Box2i &window)
{
    return static_cast<long long>(window.max.y) - window.min.y + 1;
}

/* A float slice of every third (or every) value of `base`, whose first texel is at the window's corner. */
Imf::Slice slice_of(float *base, size_t step, const Imath::Box2i &window)
{
    const size_t x_stride = step * sizeof(float);
    return Imf::Slice::Make(Imf::FLOAT, base, window, x_stride, x_stride * static_cast<size_t>(width_of(window)));
}

/* The channels behind red, green and blue: R, G, B, or Y three times.  Says what is wrong if neither is there. */
pe_status color_channels(const Imf::Header &header, const char *name, std::string channels[3], pe_error *error)
{
    const Imf::ChannelList &list = header.channels();
    const bool rgb = list.findChannel("R") && list.findChannel("G") && list.findChannel("B");
    static const char *const letters[3] = { "R", "G", "B" };

    if (!rgb && list.findChannel("RY"))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: holds luminance and chroma (Y, RY, BY); convert it to R, G, B",
                       name);
    if (!rgb && !list.findChannel("Y"))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: has neither channels R, G, B nor a channel Y", name);
    for (int c = 0; c < 3; c++) {
        channels[c] = rgb ? letters[c] : "Y";
        const Imf::Channel *channel = list.findChannel(channels[c]);
        if (channel->xSampling != 1 || channel->ySampling != 1)
            return pe_fail(error, PE_ERROR_FORMAT, "%s: channel %s is subsampled; resample it to full size", name,
                           channels[c].c_str());
    }
    return PE_OK;
}

/* OpenEXR reads a channel into one slice only, so Y is read once, into red, and copied. */
void read_pixels(Imf::InputPart &part, const std::string channels[3], const Imath::Box2i &window, float *rgb,
                 float *alpha)
{
    Imf::FrameBuffer frame;
    const size_t texels = static_cast<size_t>(width_of(window)) * static_cast<size_t>(height_of(window));
    const bool gray = channels[0] == channels[1];

    for (int c = 0; c < (gray ? 1 : 3); c++)
        frame.insert(channels[c], slice_of(rgb + c, 3, window));
    if (alpha)
        frame.insert("A", slice_of(alpha, 1, window));
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    for (size_t texel = 0; gray && texel < texels; texel++)
        rgb[3 * texel + 1] = rgb[3 * texel + 2] = rgb[3 * texel];
}

/* An opacity, as pe_image has it; what is not a number is transparent. */
void clip(float *alpha, size_t texels)
{
    for (size_t k = 0; k < texels; k++)
        alpha[k] = alpha[k] > 0 ? std::min(alpha[k], 1.0f) : 0;
}

/* Copies what data and display windows share. */
void place(const float *from, const Imath::Box2i &data, float *to, const Imath::Box2i &display, size_t values)
{
    const int left = std::max(data.min.x, display.min.x), right = std::min(data.max.x, display.max.x);
    const int top = std::max(data.min.y, display.min.y), bottom = std::min(data.max.y, display.max.y);

    for (int y = top; y <= bottom && left <= right; y++)
        std::memcpy(to + values * (static_cast<size_t>(y - display.min.y) * static_cast<size_t>(width_of(display)) +
                                   static_cast<size_t>(left - display.min.x)),
                    from + values * (static_cast<size_t>(y - data.min.y) * static_cast<size_t>(width_of(data)) +
                                     static_cast<size_t>(left - data.min.x)),
                    values * sizeof(float) * static_cast<size_t>(right - left + 1));
}

pe_status read_image(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    MemoryInput input(bytes, size, name);
    Imf::MultiPartInputFile file(input, 0);
    const Imf::Header &header = file.header(0);
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    std::string channels[3];
    pe_image whole = {};

    if (header.hasType() && Imf::isDeepData(header.type()))
        return pe_fail(error, PE_ERROR_FORMAT, "%s: holds deep data; flatten it first", name);
    pe_status status = color_channels(header, name, channels, error);
    if (status != PE_OK)
        return status;
    const bool alpha = header.channels().findChannel("A") != nullptr;
    status = pe_image_allocate(name, width_of(data), height_of(data), alpha, &whole, error);
    if (status != PE_OK)
        return status;
    std::unique_ptr<pe_image, decltype(&pe_image_free)> guard(&whole, pe_image_free);
    Imf::InputPart part(file, 0);
    read_pixels(part, channels, data, whole.rgb, whole.alpha);
    status = pe_image_allocate(name, width_of(display), height_of(display), alpha, image, error);
    if (status != PE_OK)
        return status;
    place(whole.rgb, data, image->rgb, display, 3);
    if (alpha) {
        clip(whole.alpha, static_cast<size_t>(whole.width) * static_cast<size_t>(whole.height));
        place(whole.alpha, data, image->alpha, display, 1);
    }
    return PE_OK;
}

/* ---- parts ---- */

void set_attribute(Imf::Header &header, const pe_attribute &a)
{
    switch (a.type) {
    case PE_ATTRIBUTE_INT:
        header.insert(a.name, Imf::IntAttribute(a.integer));
        break;
    case PE_ATTRIBUTE_DOUBLE:
        header.insert(a.name, Imf::DoubleAttribute(a.number));
        break;
    case PE_ATTRIBUTE_VECTOR:
        header.insert(a.name, Imf::V3dAttribute(Imath::V3d(a.vector[0], a.vector[1], a.vector[2])));
        break;
    case PE_ATTRIBUTE_STRING:
        header.insert(a.name, Imf::StringAttribute(a.string));
        break;
    }
}

std::vector<unsigned char> encode_gray(const float *values, int width, int height, const pe_attribute *attributes,
                                       size_t attribute_count)
{
    const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(width - 1, height - 1));
    MemoryOutput output;
    Imf::Header header(width, height);
    Imf::FrameBuffer frame;

    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    for (size_t k = 0; k < attribute_count; k++)
        set_attribute(header, attributes[k]);
    frame.insert(
        "Y", Imf::Slice::Make(Imf::FLOAT, values, window, sizeof(float), sizeof(float) * static_cast<size_t>(width)));
    {
        Imf::OutputFile file(output, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(height);
    } /* the file's destructor writes the offset table */
    return std::move(output.bytes);
}

/* Bytes that free() releases. */
pe_status hand_out(const std::vector<unsigned char> &encoded, unsigned char **bytes, size_t *size)
{
    unsigned char *copy = static_cast<unsigned char *>(std::malloc(encoded.size()));

    if (!copy)
        throw std::bad_alloc();
    std::memcpy(copy, encoded.data(), encoded.size());
    *bytes = copy;
    *size = encoded.size();
    return PE_OK;
}

} // namespace

struct pe_exr_file {
    MemoryInput input;
    std::string name;
    std::unique_ptr<Imf::MultiPartInputFile> file;

    pe_exr_file(const unsigned char *bytes, size_t size, const char *file_name)
        : input(bytes, size, file_name), name(file_name), file(new Imf::MultiPartInputFile(input, 0))
    {
    }
};

extern "C" {

bool pe_exr_detect(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[4] = { 0x76, 0x2f, 0x31, 0x01 };

    return size >= 4 && std::memcmp(bytes, magic, 4) == 0;
}

pe_status pe_exr_read_image(const unsigned char *bytes, size_t size, const char *name, pe_image *image, pe_error *error)
{
    const pe_status status = pe_exr_check_header(bytes, size, name, error);

    if (status != PE_OK)
        return status;
    return guarded(name, error, [&] { return read_image(bytes, size, name, image, error); });
}

pe_status pe_exr_encode_gray(const float *values, int width, int height, const pe_attribute *attributes,
                             size_t attribute_count, unsigned char **bytes, size_t *size, pe_error *error)
{
    return guarded("OpenEXR output", error, [&] {
        return hand_out(encode_gray(values, width, height, attributes, attribute_count), bytes, size);
    });
}

pe_status pe_exr_open(const unsigned char *bytes, size_t size, const char *name, pe_exr_file **file, pe_error *error)
{
    const pe_status status = pe_exr_check_header(bytes, size, name, error);

    if (status != PE_OK)
        return status;
    return guarded(name, error, [&] {
        *file = new pe_exr_file(bytes, size, name);
        return PE_OK;
    });
}

void pe_exr_close(pe_exr_file *file)
{
    delete file;
}

int pe_exr_part_count(const pe_exr_file *file)
{
    return file->file->parts();
}

void pe_exr_part_size(const pe_exr_file *file, int part, long long *width, long long *height)
{
    const Imath::Box2i window = file->file->header(part).dataWindow();

    *width = width_of(window);
    *height = height_of(window);
}

bool pe_exr_get_attribute(const pe_exr_file *file, int part, pe_attribute *attribute)
{
    const Imf::Header &header = file->file->header(part);

    switch (attribute->type) {
    case PE_ATTRIBUTE_INT: {
        const auto *found = header.findTypedAttribute<Imf::IntAttribute>(attribute->name);
        if (found)
            attribute->integer = found->value();
        return found;
    }
    case PE_ATTRIBUTE_DOUBLE: {
        const auto *found = header.findTypedAttribute<Imf::DoubleAttribute>(attribute->name);
        if (found)
            attribute->number = found->value();
        return found;
    }
    case PE_ATTRIBUTE_VECTOR: {
        const auto *found = header.findTypedAttribute<Imf::V3dAttribute>(attribute->name);
        for (int c = 0; found && c < 3; c++)
            attribute->vector[c] = found->value()[c];
        return found;
    }
    case PE_ATTRIBUTE_STRING: {
        const auto *found = header.findTypedAttribute<Imf::StringAttribute>(attribute->name);
        if (found)
            attribute->string = found->value().c_str();
        return found;
    }
    }
    return false;
}

int pe_exr_carries(const void *bytes, size_t size, pe_attribute *attribute)
{
    const auto *from = static_cast<const unsigned char *>(bytes);
    pe_exr_file *file;

    if (!pe_exr_detect(from, size) || pe_exr_open(from, size, "", &file, nullptr) != PE_OK)
        return 0;
    const bool found = pe_exr_get_attribute(file, 0, attribute);
    pe_exr_close(file);
    return found;
}

pe_status pe_exr_read_part(const pe_exr_file *file, int part, float *rgb, pe_error *error)
{
    const char *name = file->name.c_str();

    return guarded(name, error, [&] {
        std::string channels[3];
        const pe_status status = color_channels(file->file->header(part), name, channels, error);

        if (status != PE_OK)
            return status;
        Imf::InputPart input(*file->file, part);
        read_pixels(input, channels, file->file->header(part).dataWindow(), rgb, nullptr);
        return PE_OK;
    });
}

} // extern "C"
