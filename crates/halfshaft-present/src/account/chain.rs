//! The line as a chain of names: `engine ─[gearbox 1:1]─ flange ─(half-shaft)─ vehicle`.

use halfshaft_results::CheckResult;

use crate::topology::{Chain, Network, Part};
use crate::words::{number, plain};

/// Widest line; a longer chain goes on in the next.
const WIDTH: usize = 92;
/// Longer lines are not told in full: the tables name everything.
const MOST_LINES: usize = 40;

/// The chains of a line, one or more lines of text each.
pub(super) fn lines(check: &CheckResult) -> Vec<String> {
    let network = Network::new(check);
    let chains = network.chains();
    let mut lines: Vec<String> =
        chains.chains.iter().flat_map(|chain| told(check, &network, chain)).collect();
    for edge in &chains.loops {
        let ends = network.edges[*edge];
        let from = plain(&network.nodes[ends.from].name);
        let to = plain(&network.nodes[ends.to].name);
        lines.push(format!("loop: {from} {} {to}", link(check, &network, *edge, ends.from)));
    }
    if lines.len() > MOST_LINES {
        let left = lines.len() - MOST_LINES;
        lines.truncate(MOST_LINES);
        lines.push(format!("... and {left} more lines; the tables name every element"));
    }
    lines
}

fn told(check: &CheckResult, network: &Network, chain: &Chain) -> Vec<String> {
    let name = |node: usize| plain(&network.nodes[node].name);
    let Some(first) = chain.nodes.first() else { return Vec::new() };
    let mut pieces = Vec::new();
    match chain.start {
        Some((node, edge)) => {
            pieces.push(format!("from {}", name(node)));
            pieces.push(format!("{} {}", link(check, network, edge, node), name(*first)));
        }
        None => pieces.push(name(*first)),
    }
    for ((edge, before), node) in chain.edges.iter().zip(&chain.nodes).zip(&chain.nodes[1..]) {
        pieces.push(format!("{} {}", link(check, network, *edge, *before), name(*node)));
    }
    folded(&pieces)
}

/// A connection as seen from one of its ends.
fn link(check: &CheckResult, network: &Network, edge: usize, seen_from: usize) -> String {
    match network.edges[edge].part {
        Part::Gear(index) => {
            let gear = &check.gears[index];
            let (sign, size) =
                if gear.ratio < 0.0 { ("−", -gear.ratio) } else { ("", gear.ratio) };
            let size = number(size, 5);
            let ratio = if network.edges[edge].from == seen_from {
                format!("{sign}{size}:1")
            } else {
                format!("{sign}1:{size}")
            };
            format!("─[{} {ratio}]─", plain(&gear.name))
        }
        Part::Shaft(index) => format!("─({})─", plain(&check.shafts[index].name)),
    }
}

/// Pieces in lines of limited width; later lines are set in.
fn folded(pieces: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + piece.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(piece);
            }
            Some(_) => lines.push(format!("    {piece}")),
            None => lines.push(piece.clone()),
        }
    }
    lines
}
