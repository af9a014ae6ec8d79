//! The decisions that lead to a renderer, each with its reason.

use super::{
    Correction, Paint, Shape, Study, Texels, Types, Vertices, Visibility, band_rows,
    order::Search,
    predict::{Candidate, Estimator},
    sampled::{MINIFIED_PART, MINIFIED_TEXELS, MOST_RATIO},
};
use crate::model::thousands;

/// Something that was decided.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Decision {
    /// What about.
    pub about: &'static str,
    /// What was chosen.
    pub choice: String,
    /// Why.
    pub reason: String,
    /// For which views it holds.
    pub basis: String,
    /// How much it may be off until it does not hold.
    pub margin: String,
    /// What the other choice costs.
    pub other: Option<Other>,
}

/// The choice that was not taken.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Other {
    /// Which.
    pub choice: String,
    /// Bytes of flash that it takes more.
    pub flash_bytes: i64,
    /// Bytes of RAM that it takes more.
    pub ram_bytes: i64,
    /// Cycles of a frame that it takes more.
    pub cycles: f64,
}

/// What holds for all views at the distance of the request.
const PROVEN: &str = "proven for all views at that distance";

/// What does not depend on views.
const SAME: &str = "the same in all views";

impl Study {
    /// What was decided, and why.
    pub(super) fn decisions(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Vec<Decision> {
        let mut decisions = vec![
            self.visibility(estimator, chosen),
            self.clipping(estimator, chosen),
            self.light(estimator, chosen),
        ];
        decisions.extend(self.perspective(estimator, chosen));
        decisions.extend(self.textures(estimator, chosen));
        decisions.extend(self.filter(estimator, chosen));
        decisions.push(self.bands(estimator, chosen));
        decisions.push(self.vertices(estimator, chosen));
        decisions
    }

    fn visibility(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Decision {
        let visibility = chosen.types.visibility;
        let worst = self.worst(visibility);
        let is_proven = self.is_proven(visibility);
        let shape = match self.shape {
            Shape::Convex => "the mesh is convex: no front face hides another".to_owned(),
            Shape::Hollow { edges } => {
                format!("not convex: {} edges bend inwards", thousands(edges))
            }
            Shape::Open { edges } => {
                format!("not closed: {} edges do not join two faces", thousands(edges))
            }
            Shape::Several => "not convex: it has several parts".to_owned(),
        };
        let percent = |part: f64| format!("{:.3} %", 100.0 * part);
        let limit = percent(self.request.wrong_part);
        let wrong = format!(
            "wrong pixels in the worst view: {} ({} of those that show it; up to {limit} may be)",
            thousands(worst.wrong),
            percent(worst.part)
        );
        let order = match &self.order {
            Search::Unneeded => String::new(),
            Search::Holes => "; a texture with holes shows what is behind".into(),
            Search::Cycle(cycle) => format!(
                "; no order of the triangles is right in all views: {cycle} ({} triangles lie in \
                 such cycles)",
                thousands(cycle.triangles)
            ),
            Search::Found(order) if self.is_right(Visibility::FixedOrder) => {
                format!("; {}", order.reason())
            }
            // Only random views are judged by others than those that an order is made from.
            Search::Found(order) => format!(
                "; {}, but in other random views it shows up to {} wrong pixels",
                order.reason(),
                thousands(self.worst(Visibility::FixedOrder).wrong)
            ),
        };
        let order = match (visibility, &self.part_order) {
            (Visibility::PartOrder, Some(parts)) => format!("{order}; {}", parts.reason()),
            (_, Some(parts)) if !self.is_right(Visibility::PartOrder) => format!(
                "{order}; {}, but up to {} wrong pixels are shown",
                parts.reason(),
                thousands(self.worst(Visibility::PartOrder).wrong)
            ),
            _ => order,
        };
        let reason = match visibility {
            Visibility::MeshOrder if is_proven => shape,
            Visibility::PartOrder if is_proven => format!("{shape}{order}"),
            Visibility::U32 => format!("{shape}{order}; nothing less shows the right surfaces"),
            _ => format!("{shape}{order}; {wrong}"),
        };
        // The next one that does not depend on an order of the triangles.
        let other =
            [Visibility::U16, Visibility::U32].into_iter().find(|&other| other > visibility);
        let basis = match visibility {
            _ if is_proven => PROVEN.into(),
            Visibility::FixedOrder | Visibility::PartOrder => self.request.views.basis_of_order(),
            _ => self.request.views.basis(),
        };
        Decision {
            about: "visibility",
            choice: visibility.title().into(),
            reason,
            basis,
            margin: if is_proven {
                "exact, in whole quanta".into()
            } else {
                format!("{} below the limit", percent(self.request.wrong_part - worst.part))
            },
            other: other.and_then(|visibility| {
                let types = Types { visibility, ..chosen.types };
                estimator.other(visibility.title(), chosen, types, chosen.rows)
            }),
        }
    }

    fn clipping(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Decision {
        let types = Types { clips: !chosen.types.clips, ..chosen.types };
        let choices = ["none", "all planes"];
        let [choice, other] = if self.clips { [choices[1], choices[0]] } else { choices };
        Decision {
            about: "clipping",
            choice: choice.into(),
            reason: if self.clips {
                format!(
                    "the model may reach {:.0} pixels from the middle of the display, beyond the \
                     1,024 of the guard band",
                    self.reach_px
                )
            } else {
                format!(
                    "the model stays within {:.0} of the 1,024 pixels that the guard band reaches, \
                     and between the near and the far plane ({} and {})",
                    self.reach_px, self.depth_range[0], self.depth_range[1]
                )
            },
            basis: PROVEN.into(),
            margin: format!("{:.0} pixels", (1_024.0 - self.reach_px).abs()),
            other: if self.clips {
                None
            } else {
                estimator.other(other, chosen, types, chosen.rows)
            },
        }
    }

    fn light(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Decision {
        let is_smooth = chosen.types.is_smooth;
        let choices = ["of triangles", "of vertices"];
        let [choice, other] = if is_smooth { [choices[1], choices[0]] } else { choices };
        let types = Types { is_smooth: !is_smooth, ..chosen.types };
        let is_flat_only = chosen.types.paint == Paint::Vertices;
        Decision {
            about: "light",
            choice: choice.into(),
            reason: if self.request.is_smooth.is_some() {
                "as asked for".into()
            } else {
                format!(
                    "normals of corners lie up to {:.1} degrees from those of their triangles (1 is \
                     not seen)",
                    self.normal_degrees
                )
            },
            basis: PROVEN.into(),
            margin: format!("{:.1} degrees", (self.normal_degrees - 1.0).abs()),
            other: if is_flat_only {
                None
            } else {
                estimator.other(other, chosen, types, chosen.rows)
            },
        }
    }

    fn perspective(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Option<Decision> {
        let sampling = self.sampling.as_ref()?;
        let Paint::Textures(correction, texels, filter) = chosen.types.paint else { return None };
        let (choice, other, others) = match correction {
            Correction::Affine => ("affine", "corrected", Correction::Adaptive),
            Correction::Adaptive => ("corrected", "affine", Correction::Affine),
        };
        let types = Types { paint: Paint::Textures(others, texels, filter), ..chosen.types };
        Some(Decision {
            about: "perspective",
            choice: choice.into(),
            reason: format!(
                "within a triangle distances differ by a factor of {:.3} at most, which takes \
                 linear coordinates {:.2} texels off (up to {} may be)",
                sampling.seen.ratio, sampling.affine_error, self.request.texels
            ),
            basis: self.request.views.basis(),
            margin: format!("{:.2} texels", (self.request.texels - sampling.affine_error).abs()),
            other: estimator.other(other, chosen, types, chosen.rows),
        })
    }

    fn textures(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Option<Decision> {
        let sampling = self.sampling.as_ref()?;
        let Paint::Textures(correction, format, filter) = chosen.types.paint else { return None };
        let [[width, height], smaller] = sampling.sizes;
        let is_smaller = smaller != [width, height];
        let texels = sampling.seen.median_texels();
        let nearness = |format: Texels| match sampling.psnr_db_of(format) {
            db if db.is_finite() => format!("{db:.1} dB from these colours"),
            _ => "the same colours".to_owned(),
        };
        let palettes = [Texels::Indexed8, Texels::Indexed4]
            .map(|format| format!("{}: {}", format.title(), nearness(format)));
        let wanted = match self.request.palette_db {
            db if db.is_finite() => format!("{db} dB are wanted"),
            _ => "as is wanted".into(),
        };
        // The next one that takes less flash, or else colours of 16 bits.
        let is_right = |&other: &Texels| {
            other > format && sampling.psnr_db_of(other) >= self.request.palette_db
        };
        let first = (format != Texels::Direct).then_some(Texels::Direct);
        let other = Texels::ALL.into_iter().find(is_right).or(first);
        Some(Decision {
            about: "textures",
            choice: format!("{} x {} texels, {}", smaller[0], smaller[1], format.title()),
            reason: format!(
                "in the middle a step of a pixel covers {texels:.2} texels of {width} x {height}: \
                 {}; {}",
                if is_smaller {
                    "a tenth of the pixels at most have fewer than one of the smaller texture"
                } else {
                    "at half the size more than a tenth of the pixels would have fewer than one"
                },
                palettes.join(", ")
            ),
            basis: self.request.views.basis(),
            margin: format!("{}, {wanted}", nearness(format)),
            other: other.and_then(|format| {
                let paint = Paint::Textures(correction, format, filter);
                let types = Types { paint, ..chosen.types };
                estimator.other(format.title(), chosen, types, chosen.rows)
            }),
        })
    }

    fn filter(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Option<Decision> {
        let sampling = self.sampling.as_ref()?;
        let filter = sampling.filter;
        let other = sampling.with_other_levels();
        let percent = |part: f64| format!("{:.1} %", 100.0 * part);
        let level = match filter.mip_levels {
            None => String::new(),
            Some(_) => format!(
                "; within a triangle distances differ by a factor of {:.3} at most (from {MOST_RATIO} \
                 on a level is chosen at each pixel)",
                sampling.seen.ratio
            ),
        };
        let minified = format!(
            "a step of a pixel covers {MINIFIED_TEXELS} texels or more in {} of the pixels (from {} \
             on there are mip levels){level}",
            percent(sampling.minified_part),
            percent(MINIFIED_PART)
        );
        let is_requested = self.request.has_mip_levels.is_some();
        let paint = chosen.types.paint.filtered(other);
        Some(Decision {
            about: "filter",
            choice: filter.title().into(),
            reason: if is_requested { format!("as asked for: {minified}") } else { minified },
            basis: self.request.views.basis(),
            margin: percent((sampling.minified_part - MINIFIED_PART).abs()),
            other: estimator.other(
                other.title(),
                chosen,
                Types { paint, ..chosen.types },
                chosen.rows,
            ),
        })
    }

    fn bands(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Decision {
        let height = self.request.display[1];
        let rows = band_rows(height);
        let next = rows.iter().rev().find(|&&other| other > chosen.rows).copied();
        let count = height.div_ceil(chosen.rows);
        let types = |rows: u32| Types { in_bands: rows < height, ..chosen.types };
        Decision {
            about: "memory",
            choice: if count == 1 {
                "the whole picture".into()
            } else {
                format!("{count} bands of {} rows", chosen.rows)
            },
            reason: if count == 1 {
                "it fits".into()
            } else {
                "higher ones do not fit, or save less than 2 % of the time".to_owned()
            },
            basis: SAME.into(),
            margin: format!(
                "{} bytes of RAM",
                thousands(
                    self.request
                        .ram_bytes
                        .saturating_sub(estimator.predict(&chosen).map_or(0, |p| p.ram_bytes()))
                        as usize
                )
            ),
            other: next.and_then(|rows| {
                let count = height.div_ceil(rows);
                estimator.other(&format!("{count} of {rows} rows"), chosen, types(rows), rows)
            }),
        }
    }

    fn vertices(&self, estimator: &Estimator<'_>, chosen: Candidate) -> Decision {
        let choices = ["kept for the frame", "projected when needed"];
        let is_stored = chosen.types.vertices == Vertices::Stored;
        let [choice, other] = if is_stored { choices } else { [choices[1], choices[0]] };
        let vertices = if is_stored { Vertices::OnDemand } else { Vertices::Stored };
        Decision {
            about: "vertices",
            choice: choice.into(),
            reason: if is_stored {
                "they fit".into()
            } else {
                "kept, they leave too little memory, or take more time".to_owned()
            },
            basis: SAME.into(),
            margin: "none needed: the pixels are the same".into(),
            other: estimator.other(other, chosen, Types { vertices, ..chosen.types }, chosen.rows),
        }
    }
}
