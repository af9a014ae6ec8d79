//! Pictures of other sizes, filtered in linear light.
//!
//! A texel of the result is the mean of what it covers of the picture, each pixel weighted by its
//! area and alpha: a box filter, whose results of half the size are the means of 2 x 2 texels.

use super::{halved, picture::Picture, texture::Stored};

/// Linear light and alpha, from 0 to 1: red, green, blue, each times alpha, and alpha.
type Linear = [f64; 4];

/// Texels in linear light, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Light {
    /// The width and height.
    pub size: [usize; 2],
    texels: Vec<Linear>,
}

impl Light {
    /// A picture in another size.
    pub(super) fn of(picture: &Picture, size: [usize; 2]) -> Self {
        let pixels = picture.pixels.iter().map(|pixel| {
            let [red, green, blue, alpha] = pixel.map(|value| f64::from(value) / 65_535.0);
            [linear(red) * alpha, linear(green) * alpha, linear(blue) * alpha, alpha]
        });
        Self { size: picture.size, texels: pixels.collect() }.resized(size)
    }

    fn resized(&self, [width, height]: [usize; 2]) -> Self {
        let columns = Coverage::all(self.size[0], width);
        let rows = Coverage::all(self.size[1], height);
        let narrow: Vec<Linear> = (self.texels.chunks_exact(self.size[0]))
            .flat_map(|row| columns.iter().map(|column| column.mean(|x| row[x])))
            .collect();
        let texels = (rows.iter())
            .flat_map(|row| (0..width).map(|x| row.mean(|y| narrow[y * width + x])))
            .collect();
        Self { size: [width, height], texels }
    }

    /// The levels of a mip pyramid, from this one down to one texel.
    pub(super) fn levels(self) -> Vec<Self> {
        let mut levels = vec![self];
        while let Some(level) = levels.last().filter(|level| level.size != [1, 1]) {
            levels.push(level.resized(halved(level.size)));
        }
        levels
    }

    /// The mean colour as it is stored, in steps of 8 bits.
    pub(super) fn mean(&self) -> [f64; 3] {
        let [red, green, blue, _] = self.resized([1, 1]).stored()[0];
        [red, green, blue]
    }

    /// Colours and alpha as they are stored.
    pub(super) fn stored(&self) -> Vec<Stored> {
        let stored = |&[red, green, blue, alpha]: &Linear| {
            let of = |c: f64| if alpha > 0.0 { encoded((c / alpha).min(1.0)) * 255.0 } else { 0.0 };
            [of(red), of(green), of(blue), alpha * 255.0]
        };
        self.texels.iter().map(stored).collect()
    }
}

/// What of a row of pixels a texel covers.
struct Coverage {
    first: usize,
    /// The parts of the pixels from the first on. Their sum is 1.
    weights: Vec<f64>,
}

impl Coverage {
    /// `count` texels that share a row of `pixels`.
    fn all(pixels: usize, count: usize) -> Vec<Self> {
        let step = pixels as f64 / count as f64;
        (0..count)
            .map(|texel| {
                // Whole numbers, so that no pixel is missed by rounding: in 1 / count pixels.
                let (start, end) = (texel * pixels, (texel + 1) * pixels);
                let (first, last) = (start / count, (end - 1) / count);
                let part = |pixel: usize| {
                    let covered = end.min((pixel + 1) * count) - start.max(pixel * count);
                    covered as f64 / count as f64 / step
                };
                Self { first, weights: (first..=last).map(part).collect() }
            })
            .collect()
    }

    fn mean(&self, pixel: impl Fn(usize) -> Linear) -> Linear {
        let mut sum = [0.0; 4];
        for (place, weight) in self.weights.iter().enumerate() {
            let pixel = pixel(self.first + place);
            for (sum, value) in sum.iter_mut().zip(pixel) {
                *sum += weight * value;
            }
        }
        sum
    }
}

/// Linear light from a stored value (IEC 61966-2-1), both from 0 to 1.
fn linear(stored: f64) -> f64 {
    if stored <= 0.040_45 { stored / 12.92 } else { ((stored + 0.055) / 1.055).powf(2.4) }
}

/// The stored value of linear light.
fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(size: [usize; 2], pixels: &[[u16; 4]]) -> Picture {
        Picture { size, pixels: pixels.iter().map(|p| p.map(|value| value * 257)).collect() }
    }

    fn rounded(light: &Light) -> Vec<[u8; 4]> {
        light.stored().iter().map(|texel| texel.map(|value| value.round() as u8)).collect()
    }

    #[test]
    fn every_value_survives() {
        let grey: Vec<[u16; 4]> = (0..256).map(|value| [value, 255 - value, value, 255]).collect();
        let light = Light::of(&picture([16, 16], &grey), [16, 16]);
        let expected: Vec<[u8; 4]> = grey.iter().map(|p| p.map(|value| value as u8)).collect();
        assert_eq!(rounded(&light), expected);
    }

    #[test]
    fn black_and_white_meet_at_188() {
        let (black, white) = ([0, 0, 0, 255], [255; 4]);
        let board = picture([2, 2], &[black, white, white, black]);
        // Half the light is stored as 1.055 (1/2)^(1/2.4) - 0.055 = 0.735.
        assert_eq!(rounded(&Light::of(&board, [1, 1])), [[188, 188, 188, 255]]);
        assert_eq!(Light::of(&board, [2, 2]).mean().map(f64::round), [188.0; 3]);
    }

    #[test]
    fn texels_cover_parts_of_pixels() {
        let row = picture([3, 1], &[[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]]);
        let light = Light::of(&row, [2, 1]);
        let third = [2.0 / 3.0, 1.0 / 3.0, 0.0, 1.0];
        let close = |a: Linear, b: Linear| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(close(light.texels[0], third), "{light:?}");
        assert!(close(light.texels[1], [0.0, third[1], third[0], 1.0]), "{light:?}");
        // Enlarged by a whole factor each pixel becomes several equal texels.
        let large = Light::of(&row, [6, 2]);
        assert_eq!(rounded(&large)[6..], rounded(&large)[..6]);
        assert_eq!(rounded(&large)[..3], [[255, 0, 0, 255], [255, 0, 0, 255], [0, 255, 0, 255]]);
    }

    #[test]
    fn transparent_pixels_have_no_colour() {
        let row = picture([2, 1], &[[200, 100, 0, 255], [0, 255, 255, 0]]);
        assert_eq!(rounded(&Light::of(&row, [1, 1])), [[200, 100, 0, 128]]);
    }

    #[test]
    fn levels_halve_down_to_one_texel() {
        let pixels: Vec<[u16; 4]> = (0..32).map(|i| [i * 8, 0, 0, 255]).collect();
        let picture = picture([8, 4], &pixels);
        let levels = Light::of(&picture, [8, 4]).levels();
        let sizes: Vec<[usize; 2]> = levels.iter().map(|level| level.size).collect();
        assert_eq!(sizes, [[8, 4], [4, 2], [2, 1], [1, 1]]);
        // Each is what the picture becomes in that size.
        for level in &levels {
            let direct = Light::of(&picture, level.size);
            for (a, b) in level.texels.iter().flatten().zip(direct.texels.iter().flatten()) {
                assert!((a - b).abs() < 1e-12, "{:?}", level.size);
            }
        }
    }
}
