//! The colours of a palette, and which of them each texel gets.

use std::collections::BTreeMap;

use color_quant::NeuQuant;

/// A colour as it is stored, in steps of 8 bits.
type Rgb = [f64; 3];

/// The rounds of improvement: later ones gain less than 0.1 dB.
const ROUNDS: usize = 16;

/// The steps in which a palette settles in each round.
const STEPS: usize = 2;

/// Chooses at most `count` colours for texels, so that the mean square distance from a texel to the
/// nearest one is small. `round` gives the colour that is stored for one; colours that it makes
/// equal are one.
///
/// A neural network (`NeuQuant`) gives the first palette, which is poor where few colours are
/// wanted. Each round moves colours that are missed little to where the errors are large (after
/// Patanè and Russo, "The enhanced LBG algorithm", 2001), and then every colour to the mean of its
/// texels (Lloyd, 1982).
pub(super) fn choose(texels: &[Rgb], count: usize, round: impl Fn(Rgb) -> Rgb) -> Vec<Rgb> {
    let histogram = Histogram::of(texels);
    let rounded = |colors: &[Rgb]| {
        let stored: BTreeMap<[u64; 3], Rgb> =
            colors.iter().map(|&c| round(c)).map(|c| (c.map(f64::to_bits), c)).collect();
        stored.into_values().collect::<Vec<Rgb>>()
    };
    // Of the texels themselves: those of a resampled picture lie between the steps that the
    // histogram counts in, and may be stored as another colour.
    let all = rounded(texels);
    if all.len() <= count {
        return all;
    }
    let rgba: Vec<u8> = (texels.iter())
        .flat_map(|&[r, g, b]| [r, g, b, 255.0].map(|value| value.round() as u8))
        .collect();
    // The quality of its samples: 1 is the best. It wants at least 2 colours.
    let first = NeuQuant::new(1, count.max(2), &rgba).color_map_rgb();
    let colors = first.chunks_exact(3).map(|c| [c[0], c[1], c[2]].map(f64::from)).take(count);
    rounded(&histogram.improved(colors.collect()))
}

/// The place of the colour nearest to another one; the first of several.
pub(super) fn nearest(palette: &[Rgb], color: Rgb) -> usize {
    two_nearest(palette, color)[0].0
}

/// The places of the two nearest colours, and the squares of the distances.
fn two_nearest(palette: &[Rgb], color: Rgb) -> [(usize, f64); 2] {
    let mut best = [(0, f64::INFINITY); 2];
    for (place, entry) in palette.iter().enumerate() {
        let distance = (0..3).map(|i| (entry[i] - color[i]).powi(2)).sum();
        if distance < best[0].1 {
            best = [(place, distance), best[0]];
        } else if distance < best[1].1 {
            best[1] = (place, distance);
        }
    }
    best
}

/// How many texels have each colour.
struct Histogram {
    colors: Vec<(Rgb, f64)>,
}

/// The texels of a palette's colour.
#[derive(Clone, Copy, Default)]
struct Cluster {
    count: f64,
    sum: Rgb,
    /// The sum of the squares of their distances.
    error: f64,
    /// The texel that adds the most to it, and how much.
    worst: (Rgb, f64),
    /// What the error grows by without the colour.
    loss: f64,
}

impl Histogram {
    /// Counts texels by their colours in steps of 8 bits.
    fn of(texels: &[Rgb]) -> Self {
        let mut counts: BTreeMap<[u8; 3], f64> = BTreeMap::new();
        for texel in texels {
            *counts.entry(texel.map(|value| value.round() as u8)).or_default() += 1.0;
        }
        let colors = counts.into_iter().map(|(color, n)| (color.map(f64::from), n)).collect();
        Self { colors }
    }

    fn clusters(&self, palette: &[Rgb]) -> Vec<Cluster> {
        let mut clusters = vec![Cluster::default(); palette.len()];
        for &(color, count) in &self.colors {
            let [(place, error), (_, second)] = two_nearest(palette, color);
            let cluster = &mut clusters[place];
            cluster.count += count;
            cluster.error += error * count;
            cluster.loss += (second - error) * count;
            if error * count > cluster.worst.1 {
                cluster.worst = (color, error * count);
            }
            for (sum, value) in cluster.sum.iter_mut().zip(color) {
                *sum += value * count;
            }
        }
        clusters
    }

    /// A palette after all rounds. One that moves colours counts only if it is better than the
    /// best one before it.
    fn improved(&self, palette: Vec<Rgb>) -> Vec<Rgb> {
        let mut best = self.settled(palette);
        let mut count = best.colors.len().div_ceil(8);
        let mut skipped = 0;
        for _ in 0..ROUNDS {
            let moves = moves(&best.clusters, count, skipped);
            if moves.is_empty() {
                break;
            }
            let mut colors = best.colors.clone();
            for (from, to) in moves {
                colors[from] = best.clusters[to].worst.0;
            }
            let moved = self.settled(colors);
            if moved.error < best.error {
                (best, skipped) = (moved, 0);
            } else if count > 1 {
                count /= 2;
            } else {
                skipped += 1;
            }
        }
        best.colors
    }

    /// A palette whose colours are the means of their texels, or nearly so.
    fn settled(&self, mut colors: Vec<Rgb>) -> Settled {
        let mut clusters = self.clusters(&colors);
        for _ in 0..STEPS {
            for (color, cluster) in colors.iter_mut().zip(&clusters) {
                if cluster.count > 0.0 {
                    *color = cluster.sum.map(|sum| sum / cluster.count);
                }
            }
            clusters = self.clusters(&colors);
        }
        let error = clusters.iter().map(|cluster| cluster.error).sum();
        Settled { colors, clusters, error }
    }
}

/// A palette with the texels of its colours.
struct Settled {
    colors: Vec<Rgb>,
    clusters: Vec<Cluster>,
    /// The sum of the squares of all distances.
    error: f64,
}

/// Pairs of a colour that is missed little and one whose texels need help, up to `count` of them,
/// without the first `skipped`. A colour that moves halves an error that is larger than its loss.
fn moves(clusters: &[Cluster], count: usize, skipped: usize) -> Vec<(usize, usize)> {
    let sorted = |key: fn(&Cluster) -> f64| {
        let mut places: Vec<usize> = (0..clusters.len()).collect();
        places.sort_by(|&a, &b| key(&clusters[a]).total_cmp(&key(&clusters[b])));
        places
    };
    let (least, most) = (sorted(|c| c.loss), sorted(|c| -c.error));
    let is_gain =
        |&(from, to): &(usize, usize)| from != to && clusters[from].loss < clusters[to].error;
    if count > 1 {
        least.into_iter().zip(most).take(count).filter(is_gain).collect()
    } else {
        let pairs = least.iter().flat_map(|&from| most.iter().map(move |&to| (from, to)));
        pairs.filter(is_gain).skip(skipped).take(1).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(texels: &[Rgb], palette: &[Rgb]) -> f64 {
        texels.iter().map(|&texel| two_nearest(palette, texel)[0].1).sum::<f64>()
            / texels.len() as f64
    }

    /// A smooth picture: two ramps across each other.
    fn ramps() -> Vec<Rgb> {
        (0..64 * 64).map(|i| [f64::from(i % 64) * 4.0, f64::from(i / 64) * 4.0, 40.0]).collect()
    }

    #[test]
    fn few_colours_stay_as_they_are() {
        let texels = [[1.0, 2.0, 3.0], [9.0, 8.0, 7.0], [1.0, 2.0, 3.0]];
        let palette = choose(&texels, 2, |color| color);
        assert_eq!(palette, [[1.0, 2.0, 3.0], [9.0, 8.0, 7.0]]);
        assert_eq!(texels.map(|texel| nearest(&palette, texel)), [0, 1, 0]);
        // Equal when stored.
        assert_eq!(choose(&texels, 1, |_| [5.0; 3]), [[5.0; 3]]);
        assert_eq!(choose(&[], 4, |color| color), [[0.0; 3]; 0]);
    }

    #[test]
    fn colours_between_steps_of_8_bits_are_stored_as_themselves() {
        // Both are 4 in whole steps, and the first is nearer to 8.2 than to 0, of steps of 5 bits.
        let step = 255.0 / 31.0;
        let round = |color: Rgb| color.map(|c| (c / step).round() * step);
        let texels = [[4.3; 3], [3.9; 3]];
        let palette = choose(&texels, 256, round);
        assert_eq!(palette, [[0.0; 3], [step; 3]]);
        assert_eq!(texels.map(|texel| palette[nearest(&palette, texel)]), texels.map(round));
    }

    #[test]
    fn palettes_are_near_the_best_there_are() {
        let texels = ramps();
        for count in [1, 2, 3, 4, 15, 16, 64, 255] {
            let palette = choose(&texels, count, |color| color);
            assert!(palette.len() <= count, "{count}: {}", palette.len());
            // Squares of side 256 / sqrt(count) have the mean square error of side^2 / 6, which
            // whole squares cannot have for all counts.
            let bound = 256.0 * 256.0 / count as f64 / 6.0;
            let error = error(&texels, &palette);
            assert!(error < 1.25 * bound, "{count}: {error} against {bound}");
        }
        assert_eq!(choose(&texels, 16, |c| c), choose(&texels, 16, |c| c));
    }

    #[test]
    fn three_distant_colours_win_over_shades_of_one() {
        let [black, red, blue] = [[0.0; 3], [220.0, 30.0, 30.0], [40.0, 60.0, 230.0]];
        let mut texels = [[red; 6], [blue; 6]].concat();
        texels.extend([black, [195.0, 27.0, 27.0], [174.0, 41.0, 142.0]]);
        let palette = choose(&texels, 3, |color| color);
        // Red and the shade near it are one, and the mean of red and blue is nearest to blue.
        assert!(two_nearest(&palette, black)[0].1 < 1.0, "{palette:?}");
        assert!(two_nearest(&palette, red)[0].1 < 500.0, "{palette:?}");
    }

    #[test]
    fn a_rare_colour_gets_its_place() {
        // One red texel in a thousand greys is far from all of them.
        let mut texels: Vec<Rgb> = (0..1_000).map(|i| [f64::from(i % 100); 3]).collect();
        texels[500] = [255.0, 0.0, 0.0];
        let palette = choose(&texels, 16, |color| color);
        assert!(two_nearest(&palette, [255.0, 0.0, 0.0])[0].1 < 100.0, "{palette:?}");
    }
}
