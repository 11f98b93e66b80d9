//! Max pooling for prediction, applied to one picture while the picture is in cache.

use super::window;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::simd::{Job, Vector};

/// Pools `picture`, of layout `from`, and writes to `into`, of layout `layout`.
pub(crate) fn pool(
    machine: Machine,
    picture: &[f32],
    from: Layout,
    into: &mut [f32],
    layout: Layout,
) {
    machine.run(Greatest {
        picture,
        from,
        into,
        layout,
    });
}

struct Greatest<'a> {
    picture: &'a [f32],
    from: Layout,
    into: &'a mut [f32],
    layout: Layout,
}

impl Job for Greatest<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let (input, output) = (self.from.picture, self.layout.picture);
        let panels = input.channels / PANEL;
        for y in 0..output.height {
            let lines = window(y, input.height)
                .map(|y| self.picture[self.from.row_range(y)].as_chunks::<PANEL>().0);
            let into = &mut self.into[self.layout.row_range(y)];
            let pixels = into.as_chunks_mut::<PANEL>().0.chunks_exact_mut(panels);
            for (x, into) in pixels.enumerate() {
                let columns = window(x, input.width).map(|x| x * panels);
                for (panel, into) in into.iter_mut().enumerate() {
                    let mut best = lines[0][columns[0] + panel];
                    for line in lines {
                        for column in columns {
                            let other = &line[column + panel];
                            for lane in 0..PANEL {
                                let wins = other[lane] > best[lane];
                                best[lane] = if wins { other[lane] } else { best[lane] };
                            }
                        }
                    }
                    *into = best;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Isa;

    use super::*;
    use crate::batch_norm::Moments;
    use crate::max_pool::{output, pool_normalised};
    use crate::picture::Picture;
    use crate::planes::Planes;

    #[test]
    fn it_gives_what_pooling_in_training_gives_of_pictures_that_are_not_changed_on_the_way() {
        for (height, width) in [(1, 1), (2, 3), (5, 4), (8, 7)] {
            let picture = Picture {
                height,
                width,
                channels: 32,
            };
            let values: Vec<f32> = (0..picture.len())
                .map(|at| f32::from(u8::try_from(at % 251).expect("below 251")))
                .map(|value| (value * 91.0) % 251.0)
                .collect();
            for isa in Isa::available() {
                let machine = Machine::with(isa).expect("available");
                let mut raw = Planes::zeros(picture, 0, 1);
                raw.set(0, &values);
                let mut expected = Planes::zeros(output(picture), 1, 1);
                let mut identity = Moments::zeros(picture.channels);
                identity.scale.fill(1.0);
                let mut choices = vec![0; output(picture).len()];
                pool_normalised(machine, &raw, 1, &identity, &mut expected, &mut choices);

                let mut found = Planes::zeros(output(picture), 1, 1);
                let (from, layout) = (raw.layout(), found.layout());
                pool(machine, raw.first(1), from, found.first_mut(1), layout);
                assert_eq!(found.first(1), expected.first(1), "{isa} {picture}");
            }
        }
    }
}
