#!/usr/bin/env bash
# Runs the steps of docs/ci/ as the services would, in a project of two shaders: once as they are, once with a wrong
# factor in one; then after TWINSHADE_REF has moved. Only paths are changed (nothing is written outside WORK), and
# packages are not installed.
#   run_recipes.sh SOURCE WORK
set -euo pipefail
source=$(realpath "$1") work=$2
here=$source/tests/ci
rm -rf "$work"
mkdir -p "$work"
work=$(realpath "$work")

fail() { echo "FAILED: $*" >&2; exit 1; }
expect() {  # wanted exit code, name of the run, its command
  local wanted=$1 name=$2 code=0
  shift 2
  "$@" >"$work/$name.log" 2>&1 || code=$?
  [ $code = "$wanted" ] || { tail -30 "$work/$name.log" >&2; fail "$name: exit code $code instead of $wanted"; }
}

# What the services clone: this commit as a branch.
git clone --quiet --bare "$source" "$work/twinshade.git"
git -C "$work/twinshade.git" update-ref refs/heads/recipe "$(git -C "$source" rev-parse HEAD)"
export TWINSHADE_REPOSITORY=$work/twinshade.git TWINSHADE_REF=recipe

# The commands of `before_script` and `script`: "- command" and "- |" with a block.
gitlab_commands() {
  awk '/^  (before_script|script):/ { on = 1; next } /^  [a-z]/ { on = 0 } !on || /^ *#/ { next }
       /^    - \|$/ { next } { sub(/^    - /, ""); print }' "$source/docs/ci/gitlab-ci.yml"
}
# The commands of one named step.
github_commands() {
  awk -v step="$1" '/^      - / { on = $0 == "      - name: " step; block = 0 } !on { next }
       block { print } /^        run: \|$/ { block = 1; next } !block && sub(/^        run: /, "")' \
    "$source/docs/ci/github-actions.yml" |
    sed -e 's/\${{ vars\.TWINSHADE_REF }}/'"$TWINSHADE_REF"'/g; s#\${{ vars\.TWINSHADE_REPOSITORY }}#'"$TWINSHADE_REPOSITORY"'#'
}
here_paths() { sed -e '/apt-get/d; /packages\.sh/d' -e "s#/tmp/twinshade#$work/clone#g; s#/opt/twinshade#$work/installed#g"; }

new_project() {
  rm -rf "$1" "$work/clone"
  mkdir -p "$1"
  cp -r "$here/shaders" "$1/shaders"
}
# Makes a branch, or moves it: to a commit behind the one that is built.
set_branch() {
  local git=(git -C "$work/twinshade.git" -c user.name=test -c user.email=test@example.com)
  "${git[@]}" update-ref "refs/heads/$1" "$("${git[@]}" commit-tree -m moved -p recipe 'recipe^{tree}')"
}
# With a cmake that only tells of it: by exit code 7.
move_branch() {
  set_branch recipe
  mkdir -p "$work/stub"
  printf '#!/bin/sh\nexit 7\n' >"$work/stub/cmake"
  chmod +x "$work/stub/cmake"
}
break_project() { sed -i 's/0\.5/0.25/' "$1/shaders/tests/halve.frag"; }

echo "GitLab"
export CI_PROJECT_DIR=$work/gitlab TWINSHADE_CACHE=$work/gitlab/.twinshade-cache
new_project "$work/gitlab"
{ echo "set -eo pipefail; cd '$CI_PROJECT_DIR'"; gitlab_commands | here_paths; } >"$work/gitlab.sh"
expect 0 gitlab bash "$work/gitlab.sh"
for file in check.xml check.json eval.xml eval.json; do [ -s "$work/gitlab/$file" ] || fail "GitLab: no $file"; done
grep -q 'failures="0"' "$work/gitlab/eval.xml" || fail "GitLab: eval.xml counts failures"
break_project "$work/gitlab"
rm -rf "$work/clone"
expect 1 gitlab-broken bash "$work/gitlab.sh"
grep -q '<failure' "$work/gitlab/eval.xml" || fail "GitLab: eval.xml names no failure"

echo "GitHub"
export GITHUB_PATH=$work/github_path GITHUB_OUTPUT=$work/github_output TWINSHADE_CACHE=.twinshade-cache
new_project "$work/github"
: >"$GITHUB_PATH"
: >"$GITHUB_OUTPUT"
cp -r "$work/gitlab/.twinshade" "$work/installed"  # as its cache would bring it
step() {
  {
    echo "set -eo pipefail; cd '$work/github'; PATH=\$(tail -1 '$GITHUB_PATH'):\$PATH"
    github_commands "$1" | here_paths
  } >"$work/step.sh"
}
set_branch feature/recipe  # whose name ends in the wanted one's
step "Find the commit"
expect 0 github-commit bash "$work/step.sh"
[ "$(cat "$GITHUB_OUTPUT")" = "commit=$(git -C "$work/twinshade.git" rev-parse recipe)" ] || fail "GitHub: not the commit"
step "Install Twinshade"
expect 0 github-install bash "$work/step.sh"
step "Check"
expect 0 github-check bash "$work/step.sh"
step "Test"
expect 0 github-test bash "$work/step.sh"
break_project "$work/github"
expect 1 github-broken bash "$work/step.sh"
grep -q '^::error file=shaders/tests/halve' "$work/github-broken.log" || fail "GitHub: no annotation"
echo "A branch that has moved"
move_branch
rm -rf "$work/clone"
expect 7 gitlab-moved env PATH="$work/stub:$PATH" bash "$work/gitlab.sh"
rm -rf "$work/clone"
step "Install Twinshade"
sed -i '1s#PATH=\$(#PATH='"$work/stub"':$(#' "$work/step.sh"
expect 7 github-moved bash "$work/step.sh"
echo "both recipes pass and fail as they should"
