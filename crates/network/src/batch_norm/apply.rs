//! Normalises pictures, adds a shortcut and applies ReLU.

use rayon::prelude::*;

use super::Moments;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Vector};

/// Pictures that are added to the normalised pictures before ReLU.
#[derive(Clone, Copy)]
pub(crate) enum Shortcut<'a> {
    Nothing,
    /// Pictures added unchanged.
    Identity(&'a Planes),
    /// Pictures that are normalised before they are added.
    Normalised(&'a Planes, &'a Moments),
}

/// Computes into = max(0, raw · scale + shift + shortcut) for the first `count` pictures, with scale and shift of `moments`.
pub(crate) fn apply(
    machine: Machine,
    raw: &Planes,
    count: usize,
    moments: &Moments,
    shortcut: Shortcut<'_>,
    into: &mut Planes,
) {
    let layout = into.layout();
    let raws = raw.first(count).par_chunks_exact(raw.layout().len());
    let images = into.first_mut(count).par_chunks_exact_mut(layout.len());
    images
        .zip(raws)
        .enumerate()
        .for_each(|(image, (into, raw))| {
            let picture = |planes: &Planes| {
                let length = planes.layout().len();
                (image * length..(image + 1) * length, planes.layout())
            };
            let shortcut = match shortcut {
                Shortcut::Nothing => RowShortcut::Nothing,
                Shortcut::Identity(other) => {
                    let (range, layout) = picture(other);
                    RowShortcut::Identity(&other.first(count)[range], layout)
                }
                Shortcut::Normalised(other, moments) => {
                    let (range, _) = picture(other);
                    RowShortcut::Normalised(&other.first(count)[range], moments)
                }
            };
            machine.run(Apply {
                raw,
                moments,
                shortcut,
                into,
                layout,
            });
        });
}

/// Part of a [`Shortcut`] for one picture.
#[derive(Clone, Copy)]
enum RowShortcut<'a> {
    Nothing,
    Identity(&'a [f32], Layout),
    Normalised(&'a [f32], &'a Moments),
}

/// Task of [`apply`] for one picture.
struct Apply<'a> {
    /// Convolution outputs of the picture, without a border.
    raw: &'a [f32],
    moments: &'a Moments,
    shortcut: RowShortcut<'a>,
    into: &'a mut [f32],
    layout: Layout,
}

impl Job for Apply<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let length = self.layout.picture.width * self.layout.picture.channels;
        for (y, raw) in self.raw.chunks_exact(length).enumerate() {
            let into = &mut self.into[self.layout.row_range(y)];
            match self.shortcut {
                RowShortcut::Nothing => {
                    each_panel(raw, self.moments, into, |_, _, value, _| value);
                }
                RowShortcut::Identity(other, layout) => {
                    let other = other[layout.row_range(y)].as_chunks::<PANEL>().0;
                    each_panel(raw, self.moments, into, |place, _, value, lane| {
                        value + other[place][lane]
                    });
                }
                RowShortcut::Normalised(other, moments) => {
                    let other = other[y * length..][..length].as_chunks::<PANEL>().0;
                    let (scale, _) = moments.scale.as_chunks::<PANEL>();
                    let (shift, _) = moments.shift.as_chunks::<PANEL>();
                    each_panel(raw, self.moments, into, |place, panel, value, lane| {
                        value + (other[place][lane] * scale[panel][lane] + shift[panel][lane])
                    });
                }
            }
        }
    }
}

/// Normalises a row, adds the shortcut by calling `add`, and applies ReLU.
#[inline(always)]
fn each_panel(
    raw: &[f32],
    moments: &Moments,
    into: &mut [f32],
    add: impl Fn(usize, usize, f32, usize) -> f32,
) {
    let (scale, _) = moments.scale.as_chunks::<PANEL>();
    let (shift, _) = moments.shift.as_chunks::<PANEL>();
    let (raw, _) = raw.as_chunks::<PANEL>();
    let (into, _) = into.as_chunks_mut::<PANEL>();
    let panels = scale.len();
    let pixels = raw.chunks_exact(panels).zip(into.chunks_exact_mut(panels));
    for (pixel, (raw, into)) in pixels.enumerate() {
        for panel in 0..panels {
            for lane in 0..PANEL {
                let value = raw[panel][lane] * scale[panel][lane] + shift[panel][lane];
                into[panel][lane] = relu(add(pixel * panels + panel, panel, value, lane));
            }
        }
    }
}

/// ReLU of one value. NaN is preserved, so that a diverged training is detected.
#[inline(always)]
pub(crate) fn relu(value: f32) -> f32 {
    if value < 0.0 { 0.0 } else { value }
}
