//! Checkpoints as bytes: the safetensors format, with metadata that identify the training run.

use std::collections::BTreeMap;
use std::io::{self, BufWriter, Write};

use safetensors::tensor::{Dtype, SafeTensors};
use serde::{Deserialize, Serialize};
use serde_json::json;
use sha2::{Digest, Sha256};
use taceva_network::{Checkpoint, NamedTensor, Summary};

use super::identity::{Identity, Origin, add_numbers, hexadecimal};

/// Metadata key of the card of a checkpoint.
const KEY: &str = "taceva.checkpoint";
/// Format version. Other versions are rejected, because they come from programs that sum in a different order.
///
/// Version 3 records the algorithm of convolutions. Earlier versions always used direct convolutions.
const FORMAT: &str = "3";

/// Maximum size of a file, in bytes: four times the largest model. A checkpoint holds current weights, best weights and two optimiser moments per
/// weight.
pub(super) const FILE_MAX: u64 = 1 << 30;

/// Format version of a checkpoint, read first because it determines the layout of the other metadata.
#[derive(Deserialize)]
struct Format {
    format: String,
}

/// Metadata of a checkpoint.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Card {
    format: String,
    of: Origin,
    summary: Summary,
    /// SHA-256 digest of the training summary and of all tensors in the order of their names.
    digest: String,
}

/// Writes `checkpoint` of the training run `identity` to `file`, tensor by tensor, to avoid a second copy in memory.
pub(super) fn write(
    identity: &Identity,
    checkpoint: &Checkpoint,
    file: impl Write,
) -> io::Result<()> {
    let card = Card {
        format: FORMAT.to_owned(),
        of: identity.of.clone(),
        summary: checkpoint.summary.clone(),
        digest: digest(checkpoint)?,
    };
    let card = serde_json::to_string(&card)?;
    let mut header = BTreeMap::from([("__metadata__".to_owned(), json!({ KEY: card }))]);
    let mut end = 0;
    for tensor in &checkpoint.tensors {
        let begin = end;
        end += size_of_val(tensor.values.as_slice());
        let place = json!({ "dtype": "F32", "shape": tensor.shape, "data_offsets": [begin, end] });
        header.insert(tensor.name.clone(), place);
    }
    let mut header = serde_json::to_vec(&header)?;
    // Tensors begin at a multiple of 8 bytes.
    header.resize(header.len().next_multiple_of(8), b' ');
    let mut out = BufWriter::new(file);
    out.write_all(&(header.len() as u64).to_le_bytes())?;
    out.write_all(&header)?;
    for tensor in &checkpoint.tensors {
        for number in &tensor.values {
            out.write_all(&number.to_le_bytes())?;
        }
    }
    out.flush()
}

/// Reads a checkpoint, and the origin against which its training run is checked. The error describes the fault of `bytes`.
pub(super) fn read(bytes: &[u8]) -> Result<(Origin, Checkpoint), String> {
    if bytes.len() as u64 > FILE_MAX {
        return Err(format!("more than {FILE_MAX} bytes"));
    }
    let container = |error| format!("not a complete safetensors file: {error}");
    let (_, header) = SafeTensors::read_metadata(bytes).map_err(container)?;
    let text = header.metadata().as_ref().and_then(|keys| keys.get(KEY));
    let text = text.ok_or_else(|| format!("no `{KEY}` in the metadata"))?;
    let Format { format } = serde_json::from_str(text).map_err(|error| error.to_string())?;
    if format != FORMAT {
        return Err(format!(
            "format {}, expected {FORMAT}: written by another version of this program, whose results differ in the last digits",
            taceva_core::shown(&format)
        ));
    }
    let card: Card = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let found = SafeTensors::deserialize(bytes).map_err(container)?;
    let mut tensors: Vec<NamedTensor> = Vec::new();
    for (name, tensor) in found.tensors() {
        if tensor.dtype() != Dtype::F32 {
            return Err(format!(
                "tensor `{}` is {:?}, expected F32",
                taceva_core::shown(&name),
                tensor.dtype()
            ));
        }
        let (numbers, _) = tensor.data().as_chunks::<4>();
        tensors.push(NamedTensor {
            name,
            shape: tensor.shape().to_vec(),
            values: numbers
                .iter()
                .map(|bytes| f32::from_le_bytes(*bytes))
                .collect(),
        });
    }
    tensors.sort_by(|a, b| a.name.cmp(&b.name));
    let checkpoint = Checkpoint {
        summary: card.summary,
        tensors,
    };
    match digest(&checkpoint) {
        Ok(digest) if digest == card.digest => Ok((card.of, checkpoint)),
        _ => Err("its numbers do not match their digest".to_owned()),
    }
}

fn digest(checkpoint: &Checkpoint) -> serde_json::Result<String> {
    let mut digest = Sha256::new();
    digest.update(serde_json::to_vec(&checkpoint.summary)?);
    for tensor in &checkpoint.tensors {
        digest.update(&tensor.name);
        digest.update([0]);
        add_numbers(&mut digest, &tensor.values);
    }
    Ok(hexadecimal(digest))
}
