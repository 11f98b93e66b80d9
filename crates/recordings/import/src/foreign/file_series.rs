//! Pictures of several files, numbered consecutively.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::pictures::{Pictures, Visit};
use crate::error::ImportError;
use taceva_dataset::{ChannelOrder, FrameCodec};

/// Pictures of several files, one after another.
#[derive(Debug)]
pub(crate) struct SeveralPictures {
    /// Files, each with the number of its first picture among all pictures.
    files: Vec<(u64, Arc<dyn Pictures>)>,
    count: u64,
}

impl SeveralPictures {
    /// Pictures of `files` in this order. `files` must not be empty.
    pub(crate) fn new(files: Vec<Arc<dyn Pictures>>) -> SeveralPictures {
        let mut count = 0_u64;
        let files = files.into_iter().map(|pictures| {
            let first = count;
            count = count.saturating_add(pictures.count());
            (first, pictures)
        });
        SeveralPictures {
            files: files.collect(),
            count,
        }
    }
}

impl Pictures for SeveralPictures {
    fn path(&self) -> &Path {
        self.files[0].1.path()
    }

    fn count(&self) -> u64 {
        self.count
    }

    fn files(&self) -> Vec<(&Path, u64)> {
        let files = self.files.iter();
        files.flat_map(|(_, pictures)| pictures.files()).collect()
    }

    fn codec(&self) -> Option<FrameCodec> {
        self.files.iter().find_map(|(_, pictures)| pictures.codec())
    }

    fn absent_chunks(&self) -> Result<Vec<(String, u64)>, ImportError> {
        let mut absent: BTreeMap<String, u64> = BTreeMap::new();
        for (_, pictures) in &self.files {
            for (array, count) in pictures.absent_chunks()? {
                *absent.entry(array).or_default() += count;
            }
        }
        Ok(absent.into_iter().collect())
    }

    fn origin(&self, index: u64) -> (&Path, u64) {
        let behind = self.files.partition_point(|(first, _)| *first <= index);
        let (first, pictures) = &self.files[behind.saturating_sub(1)];
        pictures.origin(index - first)
    }

    fn visit(
        &self,
        sorted: &[u64],
        order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        for (first, pictures) in &self.files {
            let begin = sorted.partition_point(|index| index < first);
            let end = sorted.partition_point(|index| *index < first + pictures.count());
            if begin == end {
                continue;
            }
            let own: Vec<u64> = sorted[begin..end]
                .iter()
                .map(|index| index - first)
                .collect();
            pictures.visit(&own, order, &mut |index, picture| {
                each(first + index, picture)
            })?;
        }
        Ok(())
    }
}
