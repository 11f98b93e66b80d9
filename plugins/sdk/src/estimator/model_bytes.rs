//! Fitted model as bytes at the C boundary: shape of its features, names of its channels, then the bytes that the author's code saved.

use taceva_core::{Channel, Channels, ErrorKind, FeatureShape, Saved, SavedRegressor, Unit};

use crate::failure::Failure;

/// First bytes of every encoded model.
const MAGIC: &[u8; 8] = b"TACEREG1";
/// First line of a text with which the host describes a simulated fault of pictures, such as blur. The author's `load` receives the whole text.
const FAULT: &str = "taceva.fault/1";

/// Encodes the fitted model `regressor` as bytes.
pub(super) fn write(regressor: &dyn SavedRegressor) -> Result<Vec<u8>, Failure> {
    let mut bytes = MAGIC.to_vec();
    let FeatureShape {
        height,
        width,
        depth,
    } = regressor.shape();
    for count in [height, width, depth, regressor.channels().len()] {
        let count = u32::try_from(count).map_err(|_| {
            Failure::new(
                ErrorKind::OutOfRange,
                format!("{count} numbers per sample, expected at most 2^32 - 1"),
            )
        })?;
        bytes.extend(count.to_le_bytes());
    }
    for channel in regressor.channels() {
        // Names have at most 32 bytes.
        bytes.push(u8::try_from(channel.name().len()).unwrap_or(u8::MAX));
        bytes.extend(channel.name().bytes());
    }
    bytes.extend(regressor.save()?);
    Ok(bytes)
}

/// Parses the output of [`write`], or the description of a fault. Calls `load` with the bytes that the author's code saved.
pub(super) fn read<R>(
    bytes: &[u8],
    load: impl FnOnce(&Saved<'_>) -> Result<R, Failure>,
) -> Result<R, Failure> {
    let foreign = || Failure::new(ErrorKind::Protocol, "the bytes are not a fitted model");
    if let Some(numbers) = numbers_of_a_fault(bytes) {
        let names: &[&str] = match numbers {
            1 => &["gray"],
            3 => &["red", "green", "blue"],
            _ => return Err(foreign()),
        };
        let channels = names.iter().map(|name| channel(name));
        let channels = channels.collect::<Result<Vec<Channel>, Failure>>()?;
        let channels = Channels::new(channels)
            .map_err(|error| Failure::new(ErrorKind::Protocol, error.to_string()))?;
        return load(&Saved::new(bytes, &channels, FeatureShape::flat(numbers)));
    }
    let mut rest = Rest(bytes);
    if rest.take(MAGIC.len()) != Some(MAGIC) {
        return Err(foreign());
    }
    let [height, width, depth, count] = [rest.count(), rest.count(), rest.count(), rest.count()]
        .map(|count| count.ok_or_else(foreign));
    let shape = FeatureShape {
        height: height?,
        width: width?,
        depth: depth?,
    };
    let is_countable = shape
        .height
        .checked_mul(shape.width)
        .and_then(|places| places.checked_mul(shape.depth))
        .is_some();
    let mut names = Vec::new();
    for _ in 0..count? {
        let name = rest.name().ok_or_else(foreign)?;
        names.push(channel(name)?);
    }
    let channels = Channels::new(names)
        .map_err(|error| Failure::new(ErrorKind::Protocol, error.to_string()))?;
    if !is_countable {
        return Err(foreign());
    }
    load(&Saved::new(rest.0, &channels, shape))
}

/// Number of values per pixel in a description that begins with [`FAULT`], read from a line such as `numbers=3`; `None` for other bytes.
fn numbers_of_a_fault(bytes: &[u8]) -> Option<usize> {
    let mut lines = std::str::from_utf8(bytes).ok()?.lines();
    lines.next().filter(|head| *head == FAULT)?;
    lines
        .find_map(|line| line.strip_prefix("numbers="))?
        .parse()
        .ok()
}

/// Channel called `name`. `Px` to `Pz` have the unit mm, `Fx` to `Fz` have N, and other channels have [`Unit::One`].
pub(super) fn channel(name: &str) -> Result<Channel, Failure> {
    let known = Channel::SIX
        .into_iter()
        .find(|channel| channel.name() == name);
    match known {
        Some(channel) => Ok(channel),
        None => {
            Channel::named(name, Unit::One).map_err(|error| Failure::argument(error.to_string()))
        }
    }
}

/// Bytes of an encoded model that are not yet read.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(taken)
    }

    fn count(&mut self) -> Option<usize> {
        let bytes = self.take(4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(bytes)).ok()
    }

    fn name(&mut self) -> Option<&'a str> {
        let length = usize::from(*self.take(1)?.first()?);
        std::str::from_utf8(self.take(length)?).ok()
    }
}
