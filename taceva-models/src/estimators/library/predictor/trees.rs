//! Predictors that sum the leaf values of trees.

use taceva_core::ModelError;

use super::damaged;
use crate::estimators::library::guard::finite;
use crate::estimators::library::{LibraryPredictor, LibrarySizes, LibraryTensors};
use crate::training::file::tensors::Raw;

/// Predicts base + factor · Σ leaf for each target. The sum is over the trees of the target, and leaf is the value of the leaf that a sample reaches.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Trees {
    /// Constant of each target.
    base: Vec<f64>,
    /// Factor of each target.
    factor: Vec<f64>,
    /// Number of trees of each target. `trees` contains the trees target by target.
    counts: Vec<u32>,
    trees: Vec<Tree>,
}

/// Nodes of a tree, root first.
pub(crate) type Tree = Vec<Node>;

/// Node of a tree. An inner node compares one feature with a threshold; a leaf has `low` = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) feature: u32,
    /// Greatest feature value that leads to child `low`. Greater values lead to child `high`.
    pub(crate) threshold: f64,
    /// Indices of the child nodes `low` and `high`. Both are greater than the index of this node.
    pub(crate) low: u32,
    pub(crate) high: u32,
    pub(crate) value: f64,
}

const BASE: &str = "base";
const COUNTS: &str = "counts";
const FACTOR: &str = "factor";
const NODES: &str = "nodes";
const PLACES: &str = "places";
const SIZES: &str = "sizes";

impl Trees {
    /// Builds the predictor from base, factor and trees of each target.
    ///
    /// # Errors
    /// [`ModelError`] of kind `OutOfRange` if a value is not finite.
    pub(crate) fn new(
        name: &str,
        targets: Vec<(f64, f64, Vec<Tree>)>,
    ) -> Result<Trees, ModelError> {
        let mut joined = Trees {
            base: Vec::new(),
            factor: Vec::new(),
            counts: Vec::new(),
            trees: Vec::new(),
        };
        for (base, factor, trees) in targets {
            joined.base.push(base);
            joined.factor.push(factor);
            joined.counts.push(small(trees.len()));
            joined.trees.extend(trees);
        }
        let nodes = joined.trees.iter().flatten();
        finite(name, nodes.flat_map(|node| [&node.threshold, &node.value]))?;
        finite(name, joined.base.iter().chain(&joined.factor))?;
        Ok(joined)
    }

    /// Loads the predictor from a file.
    pub(crate) fn load(
        tensors: &LibraryTensors<'_>,
        sizes: LibrarySizes,
    ) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let counts = tensors.integers(COUNTS, &[sizes.targets])?;
        let lengths = tensors.integers(SIZES, &[tensors.rows(SIZES)?])?;
        let total = tensors.rows(NODES)?;
        let nodes = tensors.doubles(NODES, &[total, 2])?;
        let places = tensors.integers(PLACES, &[total, 3])?;
        let sum = |list: &[u32]| list.iter().map(|&one| u64::from(one)).sum::<u64>();
        if sum(&counts) != lengths.len() as u64 || sum(&lengths) != total as u64 {
            return Err(damaged("the sizes of trees do not add up to the nodes"));
        }
        let mut rest = nodes
            .as_chunks::<2>()
            .0
            .iter()
            .zip(places.as_chunks::<3>().0);
        let mut trees = Vec::with_capacity(lengths.len());
        for length in lengths {
            let own = rest.by_ref().take(length as usize);
            let tree: Tree = own
                .map(|(&[threshold, value], &[feature, low, high])| Node {
                    feature,
                    threshold,
                    low,
                    high,
                    value,
                })
                .collect();
            trees.push(checked(tree, sizes.features)?);
        }
        Ok(Box::new(Trees {
            base: tensors.doubles(BASE, &[sizes.targets])?,
            factor: tensors.doubles(FACTOR, &[sizes.targets])?,
            counts,
            trees,
        }))
    }
}

/// Rejects a tree with an unknown feature, or with a node that has no leaf below it.
fn checked(tree: Tree, features: usize) -> Result<Tree, ModelError> {
    let leads_on = |(place, node): (usize, &Node)| {
        let behind = |child: u32| (place + 1..tree.len()).contains(&(child as usize));
        let asks = behind(node.low) && behind(node.high) && (node.feature as usize) < features;
        node.low == 0 || asks
    };
    if !tree.is_empty() && tree.iter().enumerate().all(leads_on) {
        Ok(tree)
    } else {
        Err(damaged("a node of a tree has no leaf below"))
    }
}

/// Value of the leaf that `sample` reaches.
fn leaf(tree: &Tree, sample: &[f32]) -> f64 {
    let mut node = &tree[0];
    while node.low > 0 {
        let is_low = f64::from(sample[node.feature as usize]) <= node.threshold;
        let next = if is_low { node.low } else { node.high };
        node = &tree[next as usize];
    }
    node.value
}

/// Converts a count to `u32`, the type of counts in model files.
pub(crate) fn small(count: usize) -> u32 {
    u32::try_from(count).expect("fewer than a file holds")
}

impl LibraryPredictor for Trees {
    fn tensors(&self) -> Vec<Raw> {
        let targets = self.base.len();
        let sizes: Vec<u32> = self.trees.iter().map(|tree| small(tree.len())).collect();
        let nodes = || self.trees.iter().flatten();
        let numbers = nodes().flat_map(|node| [node.threshold, node.value]);
        let places = nodes().flat_map(|node| [node.feature, node.low, node.high]);
        let total = nodes().count();
        vec![
            Raw::doubles(BASE, vec![targets], &self.base),
            Raw::integers(COUNTS, vec![targets], &self.counts),
            Raw::doubles(FACTOR, vec![targets], &self.factor),
            Raw::doubles(NODES, vec![total, 2], &numbers.collect::<Vec<_>>()),
            Raw::integers(PLACES, vec![total, 3], &places.collect::<Vec<_>>()),
            Raw::integers(SIZES, vec![sizes.len()], &sizes),
        ]
    }

    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        let mut trees = self.trees.iter();
        for (target, place) in into.iter_mut().enumerate() {
            let own = trees.by_ref().take(self.counts[target] as usize);
            let sum: f64 = own.map(|tree| leaf(tree, sample)).sum();
            *place = self.base[target] + self.factor[target] * sum;
        }
        Ok(())
    }
}
