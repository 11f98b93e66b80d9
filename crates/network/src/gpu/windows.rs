//! Windows of a convolution: index tables for gathering pixels on the device.

use burn_tensor::backend::Backend;
use burn_tensor::{Int, Tensor, TensorData};

/// Windows of a kernel over pictures of one size.
#[derive(Clone, Debug)]
pub(crate) struct Windows<B: Backend> {
    /// Height and width of the input pictures.
    pub(crate) seen: [usize; 2],
    /// Height and width of the output.
    pub(crate) given: [usize; 2],
    /// Number of kernel positions.
    pub(crate) taps: usize,
    /// Index of the input pixel for each output pixel and kernel position.
    onward: Table<B>,
    /// Index of the output pixel for each input pixel and kernel position, for the backward pass.
    back: Table<B>,
}

/// Pixel index for each pixel and kernel position; `None` if the window of each pixel is the pixel itself.
type Table<B> = Option<Tensor<B, 1, Int>>;

/// Direction of a pass.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    /// Forward: from pictures to output.
    Onward,
    /// Backward: from the output gradient to the input gradient.
    Back,
}

impl<B: Backend> Windows<B> {
    /// Windows of a square kernel, centred on every `stride`-th pixel of every `stride`-th row.
    pub(crate) fn new(seen: [usize; 2], kernel: usize, stride: usize, device: &B::Device) -> Self {
        let given = seen.map(|length| given(length, kernel, stride));
        let itself = kernel == 1 && stride == 1;
        let table = |positions: Vec<i32>| {
            let count = positions.len();
            (!itself).then(|| Tensor::from_data(TensorData::new(positions, [count]), device))
        };
        Windows {
            seen,
            given,
            taps: kernel * kernel,
            onward: table(onward(seen, given, kernel, stride)),
            back: table(back(seen, given, kernel, stride)),
        }
    }

    /// Gathers the windows of `pixels`. Positions outside the picture are zero.
    ///
    /// # Shapes
    /// `pixels`: `[samples, pixels, channels]`. Returns `[samples, windows, taps · channels]`.
    pub(crate) fn of(&self, pixels: Tensor<B, 3>, way: Way) -> Tensor<B, 3> {
        let (table, windows) = match way {
            Way::Onward => (&self.onward, self.given),
            Way::Back => (&self.back, self.seen),
        };
        let Some(table) = table else {
            return pixels;
        };
        let [samples, count, channels] = pixels.dims();
        let with_beyond = Tensor::zeros([samples, count + 1, channels], &pixels.device());
        let with_beyond = with_beyond.slice_assign([0..samples, 0..count, 0..channels], pixels);
        let found = with_beyond.select(1, table.clone());
        found.reshape([samples, windows[0] * windows[1], self.taps * channels])
    }
}

/// Output length of a convolution along a line of `length` pixels.
pub(crate) const fn given(length: usize, kernel: usize, stride: usize) -> usize {
    (length + 2 * (kernel / 2) - kernel) / stride + 1
}

/// Index of the input pixel for each output pixel and kernel position. Positions outside the picture have the index after the last pixel.
fn onward(seen: [usize; 2], given: [usize; 2], kernel: usize, stride: usize) -> Vec<i32> {
    let place = |at: usize, tap: usize, length: usize| {
        let found = (at * stride + tap).checked_sub(kernel / 2);
        found.filter(|found| *found < length)
    };
    positions(given, seen, kernel, place)
}

/// Index of the output pixel for each input pixel and kernel position. Positions without an output pixel have the index after the last pixel.
fn back(seen: [usize; 2], given: [usize; 2], kernel: usize, stride: usize) -> Vec<i32> {
    let place = |at: usize, tap: usize, length: usize| {
        let middle = (at + kernel / 2).checked_sub(tap)?;
        let found = middle / stride;
        (middle % stride == 0 && found < length).then_some(found)
    };
    positions(seen, given, kernel, place)
}

/// Index, computed by `place`, for each pixel of a picture of size `each` and each kernel position. The index refers to a picture of size `of`.
fn positions(
    each: [usize; 2],
    of: [usize; 2],
    kernel: usize,
    place: impl Fn(usize, usize, usize) -> Option<usize>,
) -> Vec<i32> {
    let mut found = Vec::with_capacity(each[0] * each[1] * kernel * kernel);
    for row in 0..each[0] {
        for column in 0..each[1] {
            for tap in 0..kernel * kernel {
                let row = place(row, tap / kernel, of[0]);
                let column = place(column, tap % kernel, of[1]);
                let position = row.zip(column).map(|(row, column)| row * of[1] + column);
                let position = position.unwrap_or(of[0] * of[1]);
                found.push(i32::try_from(position).expect("a picture of fewer than 2³¹ pixels"));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{back, given, onward};

    #[test]
    fn a_kernel_of_three_sees_its_neighbours_and_nothing_beyond_the_edge() {
        assert_eq!(
            onward([1, 3], [1, 3], 3, 1)[..9],
            [3, 3, 3, 3, 0, 1, 3, 3, 3]
        );
    }

    #[test]
    fn the_way_back_leads_to_every_window_that_a_pixel_is_in_and_to_no_other() {
        for (seen, kernel, stride) in [
            ([5, 4], 3, 2),
            ([6, 7], 7, 2),
            ([5, 5], 1, 2),
            ([4, 3], 3, 1),
        ] {
            let given = seen.map(|length| given(length, kernel, stride));
            let (onward, back) = (
                onward(seen, given, kernel, stride),
                back(seen, given, kernel, stride),
            );
            let taps = kernel * kernel;
            let none = |area: [usize; 2]| i32::try_from(area[0] * area[1]).expect("small");
            let mut there: Vec<(usize, i32, i32)> = Vec::new();
            for (at, found) in onward.iter().enumerate() {
                if *found != none(seen) {
                    let window = i32::try_from(at / taps).expect("small");
                    there.push((at % taps, window, *found));
                }
            }
            let mut here: Vec<(usize, i32, i32)> = Vec::new();
            for (at, found) in back.iter().enumerate() {
                if *found != none(given) {
                    let pixel = i32::try_from(at / taps).expect("small");
                    here.push((at % taps, *found, pixel));
                }
            }
            there.sort_unstable();
            here.sort_unstable();
            assert_eq!(there, here, "{seen:?}, {kernel}, {stride}");
        }
    }
}
