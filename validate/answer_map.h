// Which pixels of a picture answer moves of the camera, and by how much.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mpipov {

class AnswerMap {
  public:
    // Of the image that the others are compared with. Memory: 5 bytes a pixel. Throws
    // Failure(Exit::file).
    explicit AnswerMap(std::filesystem::path reference);

    // Adds a picture from a moved camera, smallest move first (write() goes by that). How many of
    // its pixels answer: some channel differs by more than one level of 255, or is not finite in
    // one of the two alone. Throws Failure: file, interrupted.
    long long add(const std::filesystem::path& moved, double move);

    // Gray, as large as the image: the smaller the move that a pixel answers, the brighter. Throws
    // Failure(Exit::file).
    void write(const std::filesystem::path& file) const;

    // How many pixels of an image differ from its own reference (another serial render of the same
    // scene, or the one of the map) by more than a pixel next to it or it itself answers to a move
    // of next to nothing.
    struct Differing {
        long long all = 0, unexplained = 0;
    };
    Differing explain(const std::filesystem::path& own_reference,
                      const std::filesystem::path& image) const;

  private:
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    float explained(int x, int y) const;

    std::filesystem::path reference_;
    int width_ = 0, height_ = 0;
    std::uint8_t moves_ = 0;
    std::vector<std::uint8_t> first_;  // which move was the first that it answered, from 1; 0: none
    std::vector<float> largest_;       // the largest answer to a move of next to nothing
};

}  // namespace mpipov
