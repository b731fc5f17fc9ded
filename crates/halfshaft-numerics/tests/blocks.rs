//! Bordered block systems on graphs against dense systems with the same entries.
//!
//! Source of truth throughout: the dense matrix, eliminated with full pivoting in this file.

mod reference;

use halfshaft_numerics::Error;
use halfshaft_numerics::blocks::{BlockSystem, Factors, Pattern};
use halfshaft_numerics::dense::Matrix;
use proptest::prelude::{prop_assert, proptest};
use reference::Random;

/// Elimination with full pivoting: solution for each right-hand side, and the determinant's sign.
fn dense(matrix: &Matrix, rights: &[Vec<f64>]) -> (Vec<Vec<f64>>, f64) {
    let n = matrix.rows();
    let mut a: Vec<Vec<f64>> = (0..n).map(|row| matrix.row(row).to_vec()).collect();
    for (row, a) in a.iter_mut().enumerate() {
        a.extend(rights.iter().map(|right| right[row]));
    }
    let mut order: Vec<usize> = (0..n).collect();
    let mut sign = 1.0;
    for k in 0..n {
        let places = (k..n).flat_map(|row| (k..n).map(move |column| (row, column)));
        let size = |&(row, column): &(usize, usize)| a[row][column].abs();
        let best = places.max_by(|p, q| size(p).total_cmp(&size(q)));
        let (row, column) = best.expect("there is a place left");
        sign *= if (row != k) == (column != k) { 1.0 } else { -1.0 };
        a.swap(k, row);
        a.iter_mut().for_each(|row| row.swap(k, column));
        order.swap(k, column);
        sign *= a[k][k].signum();
        let pivot = a[k].clone();
        for row in &mut a[k + 1..] {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).for_each(|(entry, upper)| *entry -= factor * upper);
        }
    }
    let solve = |right: usize| {
        let mut x = vec![0.0; n];
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| a[k][j] * x[order[j]]).sum();
            x[order[k]] = (a[k][n + right] - known) / a[k][k];
        }
        x
    };
    ((0..rights.len()).map(solve).collect(), sign)
}

/// A block system with the dense matrix of the same entries, border last.
struct Pair {
    system: BlockSystem,
    matrix: Matrix,
    unknowns: usize,
    borders: usize,
}

/// A graph: each node joined to an earlier one, and some more edges.
fn graph(nodes: usize, more: usize, random: &mut Random) -> Vec<(usize, usize)> {
    let mut pick = |below: usize| (((random.next() + 1.0) / 2.0) * below as f64) as usize % below;
    let mut edges: Vec<(usize, usize)> = (1..nodes).map(|node| (pick(node), node)).collect();
    for _ in 0..if nodes > 2 { more } else { 0 } {
        edges.push((pick(nodes), pick(nodes)));
    }
    edges
}

/// Random entries; `weight` is added to the diagonal of each node's block.
fn pair(
    nodes: usize,
    edges: &[(usize, usize)],
    size: usize,
    borders: usize,
    weight: f64,
    random: &mut Random,
) -> Pair {
    let pattern = Pattern::new(nodes, edges.iter().copied());
    let mut system = BlockSystem::new(pattern, size, borders);
    let unknowns = nodes * size;
    let mut matrix = Matrix::zeros(unknowns + borders, unknowns + borders);
    let mut places: Vec<(usize, usize)> = (0..nodes).map(|node| (node, node)).collect();
    let joined = edges.iter().filter(|(a, b)| a != b);
    places.extend(joined.flat_map(|(a, b)| [(*a, *b), (*b, *a)]));
    for (row, column) in places {
        for (at, entry) in system.block_mut(row, column).iter_mut().enumerate() {
            let (i, j) = (at / size, at % size);
            let value = random.next() + if row == column && i == j { weight } else { 0.0 };
            // Edges given twice add up.
            *entry += value;
            matrix[(row * size + i, column * size + j)] += value;
        }
    }
    for k in 0..borders {
        let column: Vec<f64> = (0..unknowns).map(|_| random.next()).collect();
        let row: Vec<f64> = (0..unknowns).map(|_| random.next()).collect();
        system.set_column(k, &column);
        system.set_row(k, &row);
        for at in 0..unknowns {
            matrix[(at, unknowns + k)] = column[at];
            matrix[(unknowns + k, at)] = row[at];
        }
        for other in 0..borders {
            let value = random.next();
            system.set_corner(k, other, value);
            matrix[(unknowns + k, unknowns + other)] = value;
        }
    }
    Pair { system, matrix, unknowns, borders }
}

impl Pair {
    fn factors(&self) -> Factors {
        let mut factors = None;
        self.system.factorise(&mut factors).expect("regular");
        factors.expect("were made")
    }

    /// Largest difference of a solution from that of the dense system, over the largest entry.
    fn error(&self, transposed: bool, random: &mut Random) -> f64 {
        let right: Vec<f64> = (0..self.matrix.rows()).map(|_| random.next()).collect();
        let (mut x, mut y) = (right[..self.unknowns].to_vec(), right[self.unknowns..].to_vec());
        let matrix = if transposed { self.matrix.transpose() } else { self.matrix.clone() };
        let mut factors = self.factors();
        if transposed {
            factors.solve_transposed(&mut x, &mut y);
        } else {
            factors.solve(&mut x, &mut y);
        }
        let (exact, _) = dense(&matrix, &[right]);
        let largest = exact[0].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let found = x.iter().chain(&y);
        found.zip(&exact[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
    }
}

proptest! {
    #[test]
    fn any_graph_is_solved_like_the_dense_matrix(
        seed in 0_u64..1 << 40,
        nodes in 1_usize..14,
        more in 0_usize..6,
        size in 1_usize..14,
        borders in 0_usize..4,
    ) {
        let mut random = Random(seed);
        let edges = graph(nodes, more, &mut random);
        // Heavy diagonals keep every part that is cut off regular.
        let pair = pair(nodes, &edges, size, borders, 6.0 + nodes as f64, &mut random);
        prop_assert!(pair.error(false, &mut random) < 1e-11);
        prop_assert!(pair.error(true, &mut random) < 1e-11);
        let (_, sign) = dense(&pair.matrix, &[]);
        prop_assert!(pair.factors().sign() == sign);
    }

    // Without heavy diagonals pivots are whatever they are: rounding is measured by the residual.
    #[test]
    fn indefinite_blocks_are_solved(
        seed in 0_u64..1 << 40,
        nodes in 1_usize..10,
        more in 0_usize..4,
        size in 2_usize..14,
        borders in 0_usize..3,
    ) {
        let mut random = Random(seed);
        let edges = graph(nodes, more, &mut random);
        let pair = pair(nodes, &edges, size, borders, 0.0, &mut random);
        let mut factors = pair.factors();
        let right: Vec<f64> = (0..pair.matrix.rows()).map(|_| random.next()).collect();
        let (mut x, mut y) = (right[..pair.unknowns].to_vec(), right[pair.unknowns..].to_vec());
        factors.solve(&mut x, &mut y);
        x.append(&mut y);
        let back = pair.matrix.mul_vector(&x).expect("fits");
        let largest = x.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
        let missed = back.iter().zip(&right).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        prop_assert!(missed < 1e-8 * largest, "{missed} of {largest}");
        let (_, sign) = dense(&pair.matrix, &[]);
        prop_assert!(factors.sign() == sign);
    }

    #[test]
    fn products_are_those_of_the_dense_matrix(
        seed in 0_u64..1 << 40,
        nodes in 1_usize..10,
        more in 0_usize..5,
        size in 1_usize..4,
    ) {
        let mut random = Random(seed);
        let edges = graph(nodes, more, &mut random);
        let pair = pair(nodes, &edges, size, 0, 1.0, &mut random);
        let x: Vec<f64> = (0..pair.unknowns).map(|_| random.next()).collect();
        let start: Vec<f64> = (0..pair.unknowns).map(|_| random.next()).collect();
        for transposed in [false, true] {
            let mut out = start.clone();
            let matrix = if transposed {
                pair.system.add_transposed_product(&x, &mut out);
                pair.matrix.transpose()
            } else {
                pair.system.add_product(&x, &mut out);
                pair.matrix.clone()
            };
            let product = matrix.mul_vector(&x).expect("fits");
            for ((out, start), product) in out.iter().zip(&start).zip(product) {
                prop_assert!((out - start - product).abs() < 1e-13);
            }
        }
    }
}

/// Makes `A v = 0` by a change of one node's block.
fn make_singular(pair: &mut Pair, node: usize, size: usize, v: &[f64]) {
    let square: f64 = v[node * size..(node + 1) * size].iter().map(|x| x * x).sum();
    let mut product = vec![0.0; pair.unknowns];
    pair.system.add_product(v, &mut product);
    // The other nodes' rows must vanish too: change each node's own block.
    for at in 0..pair.unknowns / size {
        let own = &v[at * size..(at + 1) * size];
        let own_square: f64 = own.iter().map(|x| x * x).sum();
        let block = pair.system.block_mut(at, at);
        for i in 0..size {
            for j in 0..size {
                let change = -product[at * size + i] * own[j] / own_square;
                block[i * size + j] += change;
                pair.matrix[(at * size + i, at * size + j)] += change;
            }
        }
    }
    assert!(square > 0.0);
}

// A fold: the matrix has a null vector that all nodes share, the bordered matrix is regular.
#[test]
fn a_singular_matrix_with_a_regular_border_is_solved() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let nodes = 2 + (seed as usize) % 9;
        let (size, borders) = (1 + (seed as usize) % 3, 1);
        let edges = graph(nodes, (seed as usize) % 3, &mut random);
        let mut pair = pair(nodes, &edges, size, borders, 5.0, &mut random);
        let v: Vec<f64> = (0..pair.unknowns).map(|_| 1.0 + 0.5 * random.next()).collect();
        make_singular(&mut pair, nodes - 1, size, &v);
        let mut product = vec![0.0; pair.unknowns];
        pair.system.add_product(&v, &mut product);
        assert!(product.iter().all(|x| x.abs() < 1e-12), "seed {seed}");
        let (plain, transposed) = (pair.error(false, &mut random), pair.error(true, &mut random));
        assert!(plain < 1e-10 && transposed < 1e-10, "seed {seed}: {plain:e} {transposed:e}");
        let (_, sign) = dense(&pair.matrix, &[]);
        assert_eq!(pair.factors().sign(), sign, "seed {seed}");
    }
}

// The sign of the determinant of the bordered matrix does not change where the matrix itself passes
// through a singular one, and that of the plain matrix does.
#[test]
fn the_sign_passes_a_fold() {
    let mut random = Random(5);
    let edges = [(0, 1), (1, 2)];
    let mut signs = Vec::new();
    for shift in [-1e-7, 1e-7] {
        let mut numbers = Random(9);
        let mut pair = pair(3, &edges, 2, 1, 4.0, &mut numbers);
        let v: Vec<f64> = (0..6).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
        make_singular(&mut pair, 0, 2, &v);
        pair.system.block_mut(1, 1)[0] += shift;
        pair.matrix[(2, 2)] += shift;
        assert!(pair.error(false, &mut random) < 1e-9);
        let plain = Matrix::from_fn(6, 6, |i, j| pair.matrix[(i, j)]);
        signs.push((pair.factors().sign(), dense(&plain, &[]).1));
    }
    assert_eq!(signs[0].0, signs[1].0);
    assert_ne!(signs[0].1, signs[1].1);
}

/// A node with two equal neighbours, eliminated first, whose blocks are `own`: where `own` is
/// singular the whole is still regular with a border, but not the part that is cut off.
fn twins(own: f64) -> Pair {
    let pattern = Pattern::new(3, [(0, 2), (1, 2)]);
    let mut system = BlockSystem::new(pattern, 1, 1);
    let mut matrix = Matrix::zeros(4, 4);
    let mut entries = vec![(0, 0, own), (1, 1, own), (2, 2, 3.0)];
    entries.extend([(0, 2, 1.0), (2, 0, 1.0), (1, 2, 1.0), (2, 1, 1.0)]);
    for (row, column, value) in entries {
        system.block_mut(row, column)[0] = value;
        matrix[(row, column)] = value;
    }
    system.set_column(0, &[1.0, -1.0, 0.5]);
    system.set_row(0, &[1.0, -1.0, 0.25]);
    system.set_corner(0, 0, 0.1);
    for (at, (column, row)) in [(1.0, 1.0), (-1.0, -1.0), (0.5, 0.25)].into_iter().enumerate() {
        (matrix[(at, 3)], matrix[(3, at)]) = (column, row);
    }
    matrix[(3, 3)] = 0.1;
    Pair { system, matrix, unknowns: 3, borders: 1 }
}

// Equal branches that part their symmetry: the null vector is zero at the node between them.
#[test]
fn singular_parts_are_solved_or_refused() {
    let mut random = Random(1);
    for own in [1e-3, 1e-6] {
        let pair = twins(own);
        assert_eq!(pair.borders, 1);
        let error = pair.error(false, &mut random);
        assert!(error < 1e-15 / (own * own).max(1e-12) * 10.0, "{own:e}: {error:e}");
    }
    let mut factors = None;
    let refused = twins(0.0).system.factorise(&mut factors);
    assert!(matches!(refused, Err(Error::Singular { .. })), "{refused:?}");
}

// Source: the definition of a pattern; a path needs no fill, whatever the order of its nodes.
#[test]
fn trees_have_no_fill() {
    let mut random = Random(3);
    for nodes in [1, 2, 7, 40] {
        let edges = graph(nodes, 0, &mut random);
        let pattern = Pattern::new(nodes, edges.iter().copied());
        assert_eq!(pattern.nodes(), nodes);
        let mut places: Vec<usize> = (0..nodes).map(|node| pattern.position(node)).collect();
        places.sort_unstable();
        assert!(places.iter().enumerate().all(|(at, place)| at == *place));
        assert_eq!(pattern.position(pattern.last()), nodes - 1);
    }
}

#[test]
fn factors_are_used_again_and_shapes_may_change() {
    let mut random = Random(11);
    let mut factors = None;
    for (nodes, size, borders) in [(3, 2, 1), (3, 2, 1), (5, 1, 2), (1, 4, 0), (3, 2, 1)] {
        let edges = graph(nodes, 1, &mut random);
        let pair = pair(nodes, &edges, size, borders, 9.0, &mut random);
        pair.system.factorise(&mut factors).expect("regular");
        let right: Vec<f64> = (0..pair.matrix.rows()).map(|_| random.next()).collect();
        let (mut x, mut y) = (right[..pair.unknowns].to_vec(), right[pair.unknowns..].to_vec());
        let known = factors.as_mut().expect("were made");
        known.solve(&mut x, &mut y);
        let (exact, _) = dense(&pair.matrix, &[right]);
        assert!(x.iter().chain(&y).zip(&exact[0]).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    let pattern = Pattern::new(2, [(0, 1)]);
    let mut system = BlockSystem::new(pattern, 1, 0);
    system.block_mut(0, 0)[0] = f64::NAN;
    system.block_mut(1, 1)[0] = 1.0;
    let mut factors = None;
    assert!(matches!(system.factorise(&mut factors), Err(Error::Singular { .. })));
}
