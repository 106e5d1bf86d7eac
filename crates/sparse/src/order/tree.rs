//! The elimination tree of a symmetric pattern, and its postorder, which puts columns of equal pattern side by side and so
//! makes the factor's dense panels wider.

/// A postorder of the elimination tree of a symmetric pattern (lower triangle by columns) eliminated in `order`: an
/// equivalent order (Liu, SIAM J. Matrix Anal. Appl. 11, 1990, 134–172).
pub fn postordered(starts: &[u32], rows: &[u32], order: &[u32]) -> Vec<u32> {
    let parent = elimination_tree(starts, rows, order);
    let n = order.len();
    // Children in ascending order: the lists are filled from behind.
    let (mut first, mut sibling) = (vec![NONE; n + 1], vec![NONE; n]);
    for j in (0..n).rev() {
        let of = if parent[j] == NONE { n } else { parent[j] as usize };
        sibling[j] = first[of];
        first[of] = j as u32;
    }
    let (mut post, mut stack) = (Vec::with_capacity(n), vec![n as u32]);
    while let Some(&top) = stack.last() {
        let child = first[top as usize];
        if child != NONE {
            first[top as usize] = sibling[child as usize];
            stack.push(child);
        } else {
            stack.pop();
            if (top as usize) < n {
                post.push(order[top as usize]);
            }
        }
    }
    post
}

const NONE: u32 = u32::MAX;

/// Parent of every position of `order` (Liu's algorithm with path compression).
fn elimination_tree(starts: &[u32], rows: &[u32], order: &[u32]) -> Vec<u32> {
    let n = order.len();
    let mut position = vec![0_u32; n];
    order.iter().enumerate().for_each(|(at, &dof)| position[dof as usize] = at as u32);
    // Entries of the permuted upper triangle by columns.
    let mut counts = vec![0_u32; n + 1];
    let pairs = || {
        (0..n).flat_map(|j| {
            let column = &rows[starts[j] as usize..starts[j + 1] as usize];
            column.iter().map(move |&i| (i, j as u32))
        })
    };
    let sorted = |(i, j): (u32, u32)| {
        let (a, b) = (position[i as usize], position[j as usize]);
        if a < b { (a, b) } else { (b, a) }
    };
    pairs().map(sorted).filter(|(a, b)| a < b).for_each(|(_, b)| counts[b as usize + 1] += 1);
    (0..n).for_each(|j| counts[j + 1] += counts[j]);
    let (mut upper, mut next) = (vec![0_u32; counts[n] as usize], counts.clone());
    for (a, b) in pairs().map(sorted).filter(|(a, b)| a < b) {
        upper[next[b as usize] as usize] = a;
        next[b as usize] += 1;
    }
    let (mut parent, mut ancestor) = (vec![NONE; n], vec![NONE; n]);
    for j in 0..n {
        for &i in &upper[counts[j] as usize..counts[j + 1] as usize] {
            let mut node = i;
            while node != NONE && (node as usize) < j {
                let above = ancestor[node as usize];
                ancestor[node as usize] = j as u32;
                if above == NONE {
                    parent[node as usize] = j as u32;
                }
                node = above;
            }
        }
    }
    parent
}
