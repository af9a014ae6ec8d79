//! Textures as pictures on the display, without any object.

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions as _, OriginDimensions, Point, Size},
    image::ImageDrawable,
    pixelcolor::PixelColor,
    primitives::{PointsIter as _, Rectangle},
};

use super::{DynamicTexture, Grid, Outcome, Table, TexelMap, Texels, Texture, Wrap};

/// Draws those texels of a part that the target has room for, one a pixel.
fn draw_texels<F: Texels<Color: PixelColor>, T: DrawTarget<Color = F::Color>>(
    texels: F,
    size: Size,
    part: &Rectangle,
    target: &mut T,
) -> Result<(), T::Error> {
    let all = Rectangle::new(Point::zero(), size);
    let part = part.intersection(&all).intersection(&target.bounding_box());
    let texel = |Point { x, y }: Point| texels.texel(y as usize * size.width as usize + x as usize);
    if <F::Texel as Outcome<F::Color>>::DISCARDS {
        let opaque = |place| Some(Pixel(place, texel(place).color()?));
        return target.draw_iter(part.points().filter_map(opaque));
    }
    target.fill_contiguous(&part, part.points().filter_map(|place| texel(place).color()))
}

/// A picture for `embedded_graphics::image::Image`, one texel a pixel: a background of a frame or
/// of its bands, or a sprite over the objects. Transparent texels leave what is there, and so do
/// those of an alpha below one half; others are opaque. Only the texels within the target are read.
impl<F: Table<Color: PixelColor>, const W: usize, const H: usize, X: Wrap, Y: Wrap> ImageDrawable
    for Texture<F, W, H, X, Y>
{
    type Color = F::Color;

    fn draw<T: DrawTarget<Color = F::Color>>(&self, target: &mut T) -> Result<(), T::Error> {
        self.draw_sub_image(target, &self.bounding_box())
    }

    fn draw_sub_image<T: DrawTarget<Color = F::Color>>(
        &self,
        target: &mut T,
        area: &Rectangle,
    ) -> Result<(), T::Error> {
        draw_texels(*self.texels(), self.size(), area, target)
    }
}

impl<F, const W: usize, const H: usize, X, Y> OriginDimensions for Texture<F, W, H, X, Y> {
    fn size(&self) -> Size {
        Size::new(W as u32, H as u32)
    }
}

/// As a [`Texture`] is one.
impl<F: Texels<Color: PixelColor>, X: Wrap, Y: Wrap> ImageDrawable for DynamicTexture<F, X, Y> {
    type Color = F::Color;

    fn draw<T: DrawTarget<Color = F::Color>>(&self, target: &mut T) -> Result<(), T::Error> {
        self.draw_sub_image(target, &self.bounding_box())
    }

    fn draw_sub_image<T: DrawTarget<Color = F::Color>>(
        &self,
        target: &mut T,
        area: &Rectangle,
    ) -> Result<(), T::Error> {
        draw_texels(*self.texels(), self.size(), area, target)
    }
}

impl<F, X, Y> OriginDimensions for DynamicTexture<F, X, Y> {
    fn size(&self) -> Size {
        let Grid { width, height, .. } = self.grid();
        Size::new(width.length() as u32, height.length() as u32)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::pixelcolor::{Gray8, IntoStorage as _};

    use super::*;
    use crate::{
        output::Frame,
        texture::{Clamp, ColorSlice, Colors, Keyed},
    };

    static TEXELS: [Gray8; 12] = {
        let mut texels = [Gray8::new(0); 12];
        let mut index = 0;
        while index < 12 {
            texels[index] = Gray8::new(index as u8 + 1);
            index += 1;
        }
        texels
    };

    type Picture<F> = Texture<F, 4, 3, Clamp, Clamp>;

    /// What a frame of these rows of a display of 6 x 5 pixels shows, dots for its background.
    fn shown(rows: core::ops::Range<i32>, picture: &impl ImageDrawable<Color = Gray8>) -> Vec<u8> {
        let area = Rectangle::new(Point::new(0, rows.start), Size::new(6, rows.len() as u32));
        let mut pixels = std::vec![Gray8::new(0); 6 * rows.len()];
        let mut frame = Frame::without_depth(&mut pixels, area).unwrap();
        // As `embedded_graphics::image::Image` draws it at (1, 1), and a part of it at (4, 3).
        let mut moved = Moved { target: &mut frame, by: Point::new(1, 1) };
        picture.draw(&mut moved).unwrap();
        let mut moved = Moved { target: &mut frame, by: Point::new(4, 3) - Point::new(1, 1) };
        let part = Rectangle::new(Point::new(1, 1), Size::new(2, 9));
        picture.draw_sub_image(&mut moved, &part).unwrap();
        pixels.iter().map(|pixel| pixel.into_storage()).collect()
    }

    /// A target that is moved.
    struct Moved<'t, T> {
        target: &'t mut T,
        by: Point,
    }

    impl<T: DrawTarget> embedded_graphics_core::geometry::Dimensions for Moved<'_, T> {
        fn bounding_box(&self) -> Rectangle {
            let Rectangle { top_left, size } = self.target.bounding_box();
            Rectangle::new(top_left - self.by, size)
        }
    }

    impl<T: DrawTarget> DrawTarget for Moved<'_, T> {
        type Color = T::Color;
        type Error = T::Error;

        fn draw_iter<I: IntoIterator<Item = Pixel<T::Color>>>(
            &mut self,
            pixels: I,
        ) -> Result<(), T::Error> {
            let by = self.by;
            self.target.draw_iter(pixels.into_iter().map(|Pixel(at, color)| Pixel(at + by, color)))
        }

        fn fill_contiguous<I: IntoIterator<Item = T::Color>>(
            &mut self,
            area: &Rectangle,
            colors: I,
        ) -> Result<(), T::Error> {
            let area = Rectangle::new(area.top_left + self.by, area.size);
            self.target.fill_contiguous(&area, colors)
        }
    }

    #[rustfmt::skip]
    const SHOWN: [u8; 30] = [
        0, 0, 0, 0, 0, 0,
        0, 1, 2, 3, 4, 0,
        0, 5, 6, 7, 8, 0,
        0, 9, 10, 11, 6, 7,
        0, 0, 0, 0, 10, 11,
    ];

    #[test]
    fn a_texture_is_a_picture_in_frames_and_bands() {
        let texture = Picture::new(Colors::new(&TEXELS));
        assert_eq!(shown(0..5, &texture), SHOWN);
        let in_bands: Vec<u8> = (0..5).flat_map(|row| shown(row..row + 1, &texture)).collect();
        assert_eq!(in_bands, SHOWN);
        let texels = ColorSlice::new(&TEXELS).unwrap();
        let texture = DynamicTexture::<_, Clamp, Clamp>::new(texels, 4, 3).unwrap();
        assert_eq!(shown(0..5, &texture), SHOWN);
    }

    #[test]
    fn transparent_texels_leave_what_is_there() {
        let texture = Picture::new(Keyed::new(Colors::new(&TEXELS), Gray8::new(6)));
        let wanted = SHOWN.map(|texel| if texel == 6 { 0 } else { texel });
        let mut got = shown(0..5, &texture);
        // There the part lies over the last texel of the whole.
        assert_eq!(got[22], 12);
        got[22] = 0;
        assert_eq!(got, wanted);
    }
}
