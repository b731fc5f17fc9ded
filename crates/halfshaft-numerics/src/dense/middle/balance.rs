//! Balancing: a similar matrix whose rows and columns are alike in size.
//!
//! Powers of two, which round nothing. Source: B. N. Parlett, C. Reinsch, "Balancing a matrix", *Numer.
//! Math.* 13 (1969), 293-304.

use super::{LINE, Square};

/// Rounds of balancing at most.
const ROUNDS: usize = 8;

impl Square<'_> {
    /// Scales rows and columns by powers of two until their sums are alike.
    #[inline(always)]
    pub(super) fn balance(&mut self) {
        for _ in 0..ROUNDS {
            let (columns, sums) = self.sums();
            let factors: Vec<f64> =
                columns.iter().zip(&sums).map(|(c, r)| factor(*c, *r)).collect();
            if factors.iter().all(|factor| *factor == 1.0) {
                return;
            }
            for at in 0..self.order {
                // Others have changed since.
                self.balance_one(at);
            }
        }
    }

    /// Sums of the sizes of all columns and of all rows, without the diagonal.
    #[inline(always)]
    fn sums(&self) -> (Vec<f64>, Vec<f64>) {
        let (mut columns, mut sums) = (vec![0.0_f64; self.stride], Vec::with_capacity(self.order));
        for (at, row) in self.rows.chunks_exact(self.stride).enumerate() {
            let mut parts = [0.0_f64; LINE];
            let lines = row.as_chunks::<LINE>().0.iter().zip(columns.as_chunks_mut::<LINE>().0);
            for (line, columns) in lines {
                for lane in 0..LINE {
                    columns[lane] += line[lane].abs();
                    parts[lane] += line[lane].abs();
                }
            }
            columns[at] -= row[at].abs();
            sums.push(parts.iter().sum::<f64>() - row[at].abs());
        }
        columns.truncate(self.order);
        (columns, sums)
    }

    #[inline(always)]
    fn balance_one(&mut self, at: usize) {
        let (stride, order) = (self.stride, self.order);
        let others = |k: &usize| *k != at;
        let column = (0..order).filter(others).map(|k| self.at(k, at).abs()).sum::<f64>();
        let row = (0..order).filter(others).map(|k| self.at(at, k).abs()).sum::<f64>();
        let factor = factor(column, row);
        if factor != 1.0 {
            self.rows[at * stride..(at + 1) * stride].iter_mut().for_each(|x| *x /= factor);
            self.rows[at..].iter_mut().step_by(stride).for_each(|x| *x *= factor);
        }
    }
}

/// The power of two by which to scale a column so that its sum is that of the row; one where there is
/// little to gain.
#[inline(always)]
fn factor(column: f64, row: f64) -> f64 {
    if !(column > 0.0 && row > 0.0 && (column + row).is_finite()) {
        return 1.0;
    }
    let power = (0.5 * (row / column).log2()).round().clamp(-300.0, 300.0);
    let factor = power.exp2();
    if column * factor + row / factor < 0.95 * (column + row) { factor } else { 1.0 }
}
