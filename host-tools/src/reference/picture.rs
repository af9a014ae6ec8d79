//! The picture: for each pixel, all fragments that cover it.
//!
//! Carpenter, "The A-buffer, an antialiased hidden surface method", SIGGRAPH 1984, keeps the
//! surfaces of a pixel in a list for the same reason: visibility can be decided later.

use super::sample::Sample;

/// What one triangle contributes to one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fragment<C = [f64; 3]> {
    /// Depth at the pixel centre; larger is nearer.
    pub depth: f64,
    /// Red, green, blue at the pixel centre, in 0..=255 and not quantised; or another type that a
    /// closure has returned in its place.
    pub color: C,
    /// Number of the triangle; pieces of a clipped triangle share its number.
    pub triangle: usize,
}

/// A drawn picture of `width` by `height` pixels, with every layer of every pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<C = [f64; 3]> {
    width: usize,
    height: usize,
    /// All fragments, pixel after pixel, row after row.
    fragments: Vec<Fragment<C>>,
    /// Where the fragments of each pixel begin; the last entry is their number.
    starts: Vec<usize>,
}

impl<C> Picture<C> {
    /// Width in pixels.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub const fn height(&self) -> usize {
        self.height
    }

    /// The fragments of a pixel in the order in which their triangles are drawn.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn fragments(&self, x: usize, y: usize) -> &[Fragment<C>] {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) of {} x {}",
            self.width,
            self.height
        );
        let pixel = y * self.width + x;
        &self.fragments[self.starts[pixel]..self.starts[pixel + 1]]
    }

    /// The visible fragment of a pixel: the one of greatest depth. Of several equals it is the
    /// first drawn, which a depth test for "greater" keeps. `None` where only the background shows.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn nearest(&self, x: usize, y: usize) -> Option<&Fragment<C>> {
        self.fragments(x, y)
            .iter()
            .reduce(|front, next| if next.depth > front.depth { next } else { front })
    }

    /// How many triangles cover a pixel.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn layers(&self, x: usize, y: usize) -> usize {
        self.fragments(x, y).len()
    }

    /// The picture with other colours. `color` returns that of a fragment of the pixel (x, y), or
    /// `None` to leave it out.
    #[must_use]
    pub fn recolored<D: Copy>(
        &self,
        color: impl Fn([usize; 2], &Fragment<C>) -> Option<D>,
    ) -> Picture<D> {
        let mut canvas = Canvas::new((self.width, self.height));
        for y in 0..self.height {
            for x in 0..self.width {
                for fragment in self.fragments(x, y) {
                    let &Fragment { depth, triangle, .. } = fragment;
                    if let Some(color) = color([x, y], fragment) {
                        canvas.add(x, y, Fragment { depth, color, triangle });
                    }
                }
            }
        }
        canvas.into_picture()
    }
}

/// A picture while it is drawn: the fragments of all pixels in drawing order.
#[derive(Clone, Debug)]
pub(super) struct Canvas<C> {
    width: usize,
    height: usize,
    /// Each with its pixel, `y * width + x`.
    fragments: Vec<(usize, Fragment<C>)>,
}

impl<C: Copy> Canvas<C> {
    pub(super) const fn new((width, height): (usize, usize)) -> Self {
        Self { width, height, fragments: Vec::new() }
    }

    /// Shades a sample and adds the fragment on top of what the pixel holds, unless it is
    /// discarded.
    pub(super) fn shade<const N: usize>(
        &mut self,
        sample: Sample<N>,
        shade: impl Fn(Sample<N>) -> Option<C>,
    ) {
        let Sample { pixel: [x, y], triangle, depth, .. } = sample;
        if let Some(color) = shade(sample) {
            self.add(x, y, Fragment { depth, color, triangle });
        }
    }

    /// Adds a fragment on top of what the pixel holds.
    fn add(&mut self, x: usize, y: usize, fragment: Fragment<C>) {
        self.fragments.push((y * self.width + x, fragment));
    }

    /// Sorts the fragments by pixel. A counting sort is stable, so each pixel keeps the drawing
    /// order.
    pub(super) fn into_picture(self) -> Picture<C> {
        let mut starts = vec![0; self.width * self.height + 1];
        for (pixel, _) in &self.fragments {
            starts[pixel + 1] += 1;
        }
        for pixel in 1..starts.len() {
            starts[pixel] += starts[pixel - 1];
        }
        let mut next = starts.clone();
        // The place of each is that of another in the sorted list.
        let mut order = vec![0; self.fragments.len()];
        for (place, (pixel, _)) in self.fragments.iter().enumerate() {
            order[next[*pixel]] = place;
            next[*pixel] += 1;
        }
        let fragments = order.into_iter().map(|place| self.fragments[place].1).collect();
        Picture { width: self.width, height: self.height, fragments, starts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fragment(depth: f64, triangle: usize) -> Fragment {
        Fragment { depth, color: [triangle as f64, 2.0, 3.0], triangle }
    }

    #[test]
    fn each_pixel_keeps_its_fragments_in_drawing_order() {
        let mut canvas = Canvas::new((3, 2));
        let drawn = [(2, 1), (0, 0), (2, 1), (1, 0), (0, 1), (2, 1), (0, 0), (2, 0)];
        for (number, (x, y)) in (0..).zip(drawn) {
            canvas.add(x, y, fragment(0.5, number));
        }
        let picture = canvas.into_picture();
        assert_eq!((picture.width(), picture.height()), (3, 2));
        for y in 0..2 {
            for x in 0..3 {
                let expected: Vec<_> = (0..)
                    .zip(drawn)
                    .filter(|(_, at)| *at == (x, y))
                    .map(|(number, _)| fragment(0.5, number))
                    .collect();
                assert_eq!(picture.fragments(x, y), expected, "({x}, {y})");
                assert_eq!(picture.layers(x, y), expected.len());
            }
        }
    }

    #[test]
    fn the_greatest_depth_is_nearest_and_the_first_drawn_wins_a_tie() {
        let mut canvas = Canvas::new((1, 1));
        for (number, depth) in (0..).zip([0.25, 0.75, 0.75, 0.5]) {
            canvas.add(0, 0, fragment(depth, number));
        }
        assert_eq!(canvas.into_picture().nearest(0, 0), Some(&fragment(0.75, 1)));
    }

    #[test]
    fn an_empty_picture_shows_the_background() {
        let picture = Canvas::<[f64; 3]>::new((2, 2)).into_picture();
        assert_eq!(picture.nearest(1, 1), None);
        assert_eq!(picture.layers(1, 1), 0);
    }

    #[test]
    #[should_panic(expected = "pixel (2, 0) of 2 x 2")]
    fn a_pixel_beyond_the_right_side_is_not_the_next_row() {
        let _ = Canvas::<[f64; 3]>::new((2, 2)).into_picture().layers(2, 0);
    }

    #[test]
    fn other_colors_keep_the_order_and_may_leave_fragments_out() {
        let mut canvas = Canvas::new((2, 1));
        for (number, x) in (0..).zip([1, 0, 1, 1]) {
            canvas.add(x, 0, fragment(0.5, number));
        }
        let numbers = canvas.into_picture().recolored(|[x, y], fragment| {
            (fragment.triangle != 2).then_some(100 * x + y + fragment.triangle)
        });
        let of = |x| numbers.fragments(x, 0).iter().map(|f| f.color).collect::<Vec<_>>();
        assert_eq!([of(0), of(1)], [vec![1], vec![100, 103]]);
    }
}
