//! The line linearised about given twists: stiffness and damping matrices.

use halfshaft_numerics::dense::Matrix;

use crate::equations::EquationsOfMotion;

impl EquationsOfMotion {
    /// Tangent stiffness `Σ w p'(x) wᵀ` about the twists of all connections, groups by groups,
    /// N·m/rad.
    pub fn tangent_stiffness(&self, twists: &[f64]) -> Matrix {
        self.assemble(|index| self.connections[index].law.stiffness(twists[index]))
    }

    /// Viscous damping `Σ w c wᵀ` of all connections plus the dampers to ground, groups by groups,
    /// N·m·s/rad, as if each was in contact. Dry friction has no damping constant of its own and is
    /// left out.
    pub fn damping_matrix(&self) -> Matrix {
        self.damping(|index| self.connections[index].damping)
    }

    /// The same about the twists of all connections: dampers that act in contact only are left out
    /// where there is none.
    pub fn tangent_damping(&self, twists: &[f64]) -> Matrix {
        self.damping(|index| self.connections[index].damping_at(twists[index]))
    }

    fn damping(&self, value: impl Fn(usize) -> f64) -> Matrix {
        let mut matrix = self.assemble(value);
        for (group, damping) in self.ground_damping.iter().enumerate() {
            matrix[(group, group)] += damping;
        }
        matrix
    }

    /// `Σ w value wᵀ` over the connections.
    fn assemble(&self, value: impl Fn(usize) -> f64) -> Matrix {
        let mut matrix = Matrix::zeros(self.groups(), self.groups());
        for (index, connection) in self.connections.iter().enumerate() {
            let value = value(index);
            let from = connection.from;
            let to = connection.to.map(|(group, ratio)| (group, -ratio));
            for (row, row_ratio) in [from, to].into_iter().flatten() {
                for (column, column_ratio) in [from, to].into_iter().flatten() {
                    matrix[(row, column)] += value * row_ratio * column_ratio;
                }
            }
        }
        matrix
    }
}
